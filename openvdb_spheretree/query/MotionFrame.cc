// SPDX-License-Identifier: Apache-2.0
#include "MotionFrame.h"

#include <openvdb_spheretree/base/Rounding.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::detail {

using openvdb::Vec3d;

std::array<double, 3> numbers(const Vec3d& v) { return {v[0], v[1], v[2]}; }
Vec3d vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

Screw<double> moved(const RigidTransform& pose, const Screw<double>& screw)
{
    return {numbers(pose * vector(screw.point)), numbers(pose.rotate(vector(screw.axis))),
        screw.turn, screw.slide};
}

Screw<float> rounded(const Screw<double>& screw)
{
    Screw<float> result;
    for (std::size_t i = 0; i < 3; ++i) {
        result.point[i] = float(screw.point[i]);
        result.axis[i] = float(screw.axis[i]);
    }
    result.turn = float(screw.turn);
    result.slide = float(screw.slide);
    return result;
}

void requireWay(double way)
{
    if (way <= kMostExtent) return;
    OPENVDB_THROW(openvdb::ValueError,
        "a motion goes " << way << " world units, and times of contact are computed up to "
                         << kMostExtent << ": choose another unit");
}

MotionFrame::MotionFrame(const QueryData& dataA, const RigidTransform& poseA,
    const QueryData& dataB, const RigidMotion& motionB)
    : pair(dataA, poseA, dataB, motionB.start())
{
    const RigidTransform toBody = poseA.inverse();
    ofB = {numbers(toBody * motionB.point() - dataA.origin), numbers(toBody.rotate(motionB.axis())),
        motionB.radians(), motionB.slide()};
}

double MotionFrame::longestWay() const
{
    const Vec3d center = pair.pose.translation(), axis = vector(ofB.axis);
    const double fromAxis = (center - vector(ofB.point)).cross(axis).length() + pair.b->extent;
    return std::abs(ofB.turn) * fromAxis + std::abs(ofB.slide);
}

void MotionFrame::enterFloats()
{
    const double way = longestWay();
    requireWay(way);
    pair.enterFloats();
    const Screw<double> ofBInB = moved(pair.pose.inverse(), ofB);
    toA = rounded(ofB);
    toB = rounded({ofBInB.point, ofBInB.axis, -ofBInB.turn, -ofBInB.slide});
    // Of sines, their products and sums, and of the rounding of the axis, for both bodies: 64 roundings of
    // the way that a point goes, or of twice the radius of the helix where that is less. And 16 roundings of the distance that it
    // comes from: how far a way goes by is known no better.
    const double points = vector(ofB.point).length() + vector(ofBInB.point).length();
    const double lengths = pair.reach() + points;
    const double ways = std::min(2.0, std::abs(ofB.turn)) * lengths + std::abs(ofB.slide);
    pad = toFloatUp(double(pair.pad) + 0x1p-24 * (80 * ways + 16 * pair.reach()));
}

} // namespace openvdb_spheretree::detail
