// SPDX-License-Identifier: Apache-2.0
/// @file RigidTransform.h
/// @brief Where a body is: a rotation, then a translation, in doubles.
///
///     p in the world = rotation * p of the body + translation
///
/// Matrices are written as in mathematics, with points as columns, as FCL, Eigen and ROS do.
/// (OpenVDB's own Mat4 has points as rows: transpose it.)
///
/// A rotation that was printed or computed is never quite one. Within kRotationTolerance it becomes
/// the nearest rotation, so that no error of the input makes balls into ellipsoids; beyond that it
/// is refused. Tests: TestRigidTransform.cc.

#pragma once

#include <openvdb/math/Mat3.h>
#include <openvdb/Types.h>

#include <array>

namespace openvdb_spheretree {

class RigidTransform {
public:
    /// No entry of rotation^T rotation may be farther from the identity than this: eight times the
    /// rounding of floats, or six printed digits.
    static constexpr double kRotationTolerance = 1e-5;

    /// The identity.
    RigidTransform() = default;
    /// @param rotation     orthonormal within kRotationTolerance, of determinant 1; rows as written
    /// @param translation  world units
    /// @throw openvdb::ValueError if a number is not finite, or the matrix is no rotation: it says
    ///        how far off, and whether it scales or mirrors
    RigidTransform(const openvdb::Mat3d& rotation, const openvdb::Vec3d& translation);

    /// @param matrix  the rows of a 4x4 matrix one after the other; the last one must be 0 0 0 1
    /// @throw openvdb::ValueError as above, or for the last row
    static RigidTransform fromMatrix(const std::array<double, 16>& matrix);
    /// @throw openvdb::ValueError if a number is not finite
    static RigidTransform fromTranslation(const openvdb::Vec3d& translation);
    /// @param axis     of any length above 0
    /// @param radians  by the right-hand rule
    /// @throw openvdb::ValueError for an axis without length, or numbers that are not finite
    static RigidTransform fromRotation(const openvdb::Vec3d& axis, double radians);

    const openvdb::Mat3d& rotation() const { return mRotation; }
    const openvdb::Vec3d& translation() const { return mTranslation; }

    /// @return where a point of the body is.
    openvdb::Vec3d operator*(const openvdb::Vec3d& point) const
    {
        return rotate(point) + mTranslation;
    }
    /// @return where a direction of the body points.
    openvdb::Vec3d rotate(const openvdb::Vec3d& direction) const;
    /// @return what does @a first, and then this.
    RigidTransform operator*(const RigidTransform& first) const;
    RigidTransform inverse() const;
    /// @return the same place in the frame of a body: the inverse of @a body times this.
    RigidTransform seenFrom(const RigidTransform& body) const;
    /// Moves it by @a offset, after all else.
    void move(const openvdb::Vec3d& offset) { mTranslation += offset; }

private:
    openvdb::Mat3d mRotation = openvdb::Mat3d::identity();
    openvdb::Vec3d mTranslation = openvdb::Vec3d(0, 0, 0);
};

} // namespace openvdb_spheretree
