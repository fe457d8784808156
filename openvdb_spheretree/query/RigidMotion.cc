// SPDX-License-Identifier: Apache-2.0
#include "RigidMotion.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {
namespace {

using openvdb::Mat3d;
using openvdb::Vec3d;

/// A turn by less than this moves nothing that doubles would show, and has no axis to speak of.
constexpr double kLeastTurn = 1e-14;

/// Rotation matrix to axis and angle, by the quaternion with the largest component first (S. W. Shepperd,
/// "Quaternion from rotation matrix", 1978): exact also near half a turn.
void axisAndAngle(const Mat3d& m, Vec3d& axis, double& radians)
{
    const double trace = m(0, 0) + m(1, 1) + m(2, 2);
    const double squares[4] = {
        1 + trace, 1 + 2 * m(0, 0) - trace, 1 + 2 * m(1, 1) - trace, 1 + 2 * m(2, 2) - trace};
    const Vec3d odd(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)); // 4 w (x, y, z)
    const int largest = int(std::max_element(squares, squares + 4) - squares);
    const double twice = std::sqrt(squares[largest]);
    double w = 0.5 * twice;
    if (largest == 0) {
        axis = odd / (2 * twice);
    } else {
        const int i = largest - 1, j = (i + 1) % 3, k = (i + 2) % 3;
        axis[i] = 0.5 * twice;
        axis[j] = (m(i, j) + m(j, i)) / (2 * twice);
        axis[k] = (m(i, k) + m(k, i)) / (2 * twice);
        w = odd[i] / (2 * twice);
    }
    if (w < 0) {
        w = -w;
        axis = -axis;
    }
    const double length = axis.length();
    radians = 2 * std::atan2(length, w);
    if (length > 0) axis /= length;
}

} // namespace

RigidMotion RigidMotion::line(const RigidTransform& start, const Vec3d& translation)
{
    RigidTransform::fromTranslation(translation); // checks the numbers
    RigidMotion motion(start);
    motion.mSlide = translation.length();
    if (motion.mSlide > 0) motion.mAxis = translation / motion.mSlide;
    return motion;
}

RigidMotion RigidMotion::screw(const RigidTransform& start, const RigidTransform& end)
{
    const RigidTransform change = end * start.inverse();
    RigidMotion motion(start);
    axisAndAngle(change.rotation(), motion.mAxis, motion.mRadians);
    if (motion.mRadians < kLeastTurn) return line(start, end.translation() - start.translation());
    // The point of the axis next to the body's start: far points would lose digits.
    const Vec3d from = start.translation(), moved = end.translation() - from;
    motion.mSlide = moved.dot(motion.mAxis);
    const Vec3d across = moved - motion.mSlide * motion.mAxis;
    motion.mPoint =
        from + 0.5 * (across + motion.mAxis.cross(across) / std::tan(0.5 * motion.mRadians));
    return motion;
}

RigidMotion RigidMotion::screw(const RigidTransform& start, const Vec3d& point, const Vec3d& axis,
    double radians, double slide)
{
    RigidTransform::fromRotation(axis, radians); // checks the numbers
    RigidTransform::fromTranslation(point + Vec3d(slide));
    if (std::abs(radians) > 2 * M_PI) {
        OPENVDB_THROW(openvdb::ValueError,
            "a screw turns by " << radians << " radians, more than once around: divide the motion");
    }
    RigidMotion motion(start);
    motion.mPoint = point;
    motion.mAxis = axis / std::max({std::abs(axis[0]), std::abs(axis[1]), std::abs(axis[2])});
    motion.mAxis /= motion.mAxis.length();
    motion.mRadians = radians;
    motion.mSlide = slide;
    return motion;
}

/// Where the axis is far away, the way is the small difference of large numbers, unless it is written as one: as in
/// MotionFrame.h.
RigidTransform RigidMotion::at(double time) const
{
    RigidTransform pose = RigidTransform::fromRotation(mAxis, mRadians * time) * mStart;
    const Vec3d from = mStart.translation(), q = from - mPoint, v = mAxis.cross(q);
    const double half = std::sin(0.5 * mRadians * time), sine = std::sin(mRadians * time);
    const Vec3d way = sine * v + 2 * half * half * mAxis.cross(v) + time * mSlide * mAxis;
    pose.move(from + way - pose.translation());
    return pose;
}

} // namespace openvdb_spheretree
