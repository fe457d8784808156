// SPDX-License-Identifier: Apache-2.0
/// @file RigidMotion.h
/// @brief A body on its way from one pose to another, as a time runs from 0 to 1: along a line, or a screw.
///
/// A screw turns about an axis at a steady rate, and moves along it. There is one between any two poses (M. Chasles, 1830).
/// Each point of the body goes along a helix, at a steady speed: that is what makes exact times of
/// contact quick to find (ContinuousCollide.h). Tests: TestRigidMotion.cc.

#pragma once

#include "RigidTransform.h"

namespace openvdb_spheretree {

class RigidMotion {
public:
    /// From @a start, without turning. @a translation is in world units.
    /// @throw openvdb::ValueError if a number is not finite
    static RigidMotion line(const RigidTransform& start, const openvdb::Vec3d& translation);

    /// The screw from one pose to another, by half a turn at most.
    static RigidMotion screw(const RigidTransform& start, const RigidTransform& end);

    /// @brief About any axis.
    /// @param point    on the axis, in the world
    /// @param axis     its direction, of any length above 0
    /// @param radians  by the right-hand rule; a full turn at most, either way
    /// @param slide    along the axis, in world units
    /// @throw openvdb::ValueError for an axis without length, more than a turn, or numbers that are not
    ///        finite
    static RigidMotion screw(const RigidTransform& start, const openvdb::Vec3d& point,
        const openvdb::Vec3d& axis, double radians, double slide);

    /// @param time  0 to 1
    RigidTransform at(double time) const;

    const RigidTransform& start() const { return mStart; }
    /// @name The axis, in the world, and the way along it from time 0 to 1
    /// @{
    const openvdb::Vec3d& point() const { return mPoint; }
    const openvdb::Vec3d& axis() const { return mAxis; } ///< unit
    double radians() const { return mRadians; }
    double slide() const { return mSlide; }
    /// @}

private:
    /// Stands still. (None without arguments: `{}` would be a pose as well as a motion.)
    explicit RigidMotion(const RigidTransform& start) : mStart(start) {}

    RigidTransform mStart;
    openvdb::Vec3d mPoint = openvdb::Vec3d(0, 0, 0), mAxis = openvdb::Vec3d(0, 0, 1);
    double mRadians = 0, mSlide = 0;
};

} // namespace openvdb_spheretree
