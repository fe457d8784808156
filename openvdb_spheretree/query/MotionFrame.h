// SPDX-License-Identifier: Apache-2.0
/// @file MotionFrame.h
/// @brief Two bodies, of which one moves, in each other's frames.
///
/// The frame of a block stands still, and a sphere of the other body comes along a helix: that of b in the frame of a; and
/// in the frame of b, where a goes the way back. A center is at
///
///     center(t) = start + sin(w t) v + (1 - cos(w t)) k + t slide,
///
/// with v = axis x q, k = -(q across the axis), q = start - a point of the axis. Written so, rounding is in proportion
/// to the way, not to how far the axis is: a screw of a small turn has its axis far away. The speed is steady, and the
/// acceleration is w^2 |k|.

#pragma once

#include "PairFrame.h"
#include "RigidMotion.h"

#include <openvdb/Types.h>

#include <array>

namespace openvdb_spheretree::detail {

/// How spheres of the other body move in the frame of a block.
template <typename Real>
struct Screw {
    std::array<Real, 3> point, axis; ///< of the axis; unit
    Real turn, slide;                ///< per time
};

Screw<float> rounded(const Screw<double>& screw);
/// The same way, of what the pose takes there.
Screw<double> moved(const RigidTransform& pose, const Screw<double>& screw);
std::array<double, 3> numbers(const openvdb::Vec3d& v);
openvdb::Vec3d vector(const std::array<double, 3>& v);
/// @throw openvdb::ValueError for a way that is too long to square distances in floats
void requireWay(double way);

struct MotionFrame {
    PairFrame pair;                  ///< at time 0
    Screw<double> ofB;               ///< in the frame of a
    Screw<float> toA = {}, toB = {}; ///< of spheres of the other body
    float pad = 0;                   ///< as of a PairFrame, at any time

    MotionFrame(const QueryData& dataA, const RigidTransform& poseA, const QueryData& dataB,
        const RigidMotion& motionB);

    /// @throw openvdb::ValueError if anything comes to lie too far to square distances in floats
    void enterFloats();
    /// @return the longest way that a point of b goes in a time of 1.
    double longestWay() const;
};

} // namespace openvdb_spheretree::detail
