// SPDX-License-Identifier: Apache-2.0
#include "PairFrame.h"

#include <openvdb_spheretree/base/Rounding.h>

#include <openvdb/Exceptions.h>

#include <cmath>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Vec3d;

/// Beyond this a translation is not asked about in floats: empty lanes (1e15) must stay the farthest.
constexpr double kMostShift = 1e13;

/// @return no less than the length.
double size(const Vec3d& v) { return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]); }

FloatPose rounded(const RigidTransform& pose)
{
    FloatPose result;
    for (std::size_t i = 0; i < 9; ++i) {
        result.rotation[i] = float(pose.rotation()(int(i / 3), int(i % 3)));
    }
    for (std::size_t i = 0; i < 3; ++i) result.translation[i] = float(pose.translation()[int(i)]);
    return result;
}

} // namespace

PairFrame::PairFrame(const QueryData& dataA, const RigidTransform& poseA, const QueryData& dataB,
    const RigidTransform& poseB)
    : a(&dataA.spheres), b(&dataB.spheres), pose(poseB.seenFrom(poseA))
{
    // Blocks have origins of their own.
    pose.move(pose.rotate(dataB.origin) - dataA.origin);
    const double lengths = double(a->extent) + b->extent + size(pose.translation())
        + size(poseA.translation()) + size(poseB.translation()) + size(dataA.origin)
        + size(dataB.origin);
    rounding = 0x1p-49 * lengths;
}

void PairFrame::enterFloats()
{
    const double shift = size(pose.translation());
    if (shift > kMostShift) {
        OPENVDB_THROW(openvdb::ValueError,
            "the bodies are " << shift << " world units apart, and distances are computed up to "
                              << kMostShift << ": choose another unit");
    }
    toA = rounded(pose);
    toB = rounded(pose.inverse());
    pad = toFloatUp(0x1p-24 * (8 * shift + 13 * (double(a->extent) + b->extent)) + rounding);
}

double PairFrame::gap(const FloatSphere& ofA, const FloatSphere& ofB) const
{
    const Vec3d moved = pose * Vec3d(ofB.x, ofB.y, ofB.z);
    return (moved - Vec3d(ofA.x, ofA.y, ofA.z)).length() - ofA.r - ofB.r;
}

} // namespace openvdb_spheretree::detail
