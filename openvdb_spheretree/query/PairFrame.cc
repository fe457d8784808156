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
    : a(&dataA.spheres), b(&dataB.spheres)
{
    const RigidTransform relative = poseA.inverse() * poseB;
    // Blocks have origins of their own.
    pose = RigidTransform(relative.rotation(), relative * dataB.origin - dataA.origin);
    const double shift = pose.translation().length(), extents = double(a->extent) + b->extent;
    rounding = 0x1p-49
        * (extents + shift + poseA.translation().length() + poseB.translation().length()
            + dataA.origin.length() + dataB.origin.length());
    if (shift > kMostShift) return; // floats are not asked for
    toA = rounded(pose);
    toB = rounded(pose.inverse());
    pad = toFloatUp(0x1p-24 * (8 * shift + 13 * extents) + rounding);
}

double PairFrame::gap(const FloatSphere& ofA, const FloatSphere& ofB) const
{
    const Vec3d moved = pose * Vec3d(ofB.x, ofB.y, ofB.z);
    return (moved - Vec3d(ofA.x, ofA.y, ofA.z)).length() - ofA.r - ofB.r;
}

void PairFrame::requireNear() const
{
    const double shift = pose.translation().length();
    if (shift <= kMostShift) return;
    OPENVDB_THROW(openvdb::ValueError,
        "the bodies are " << shift << " world units apart, and distances are computed up to "
                          << kMostShift << ": choose another unit");
}

} // namespace openvdb_spheretree::detail
