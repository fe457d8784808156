// SPDX-License-Identifier: Apache-2.0
/// @file PrincipalAxes.h
/// @brief The eigenvalues of a symmetric 3 x 3 matrix and a frame of its eigenvectors, always the same
/// one for the same matrix.
///
/// By Jacobi's rotations (Golub and Van Loan, Matrix Computations, section 8.5): each makes one of the
/// three numbers off the diagonal 0, and a few rounds make all of them so. OpenVDB's
/// diagonalizeSymmetricMatrix() stops at an absolute 1e-15: a small part's moments, of 1e-12, would never
/// be turned at all. Here a number off the diagonal is 0 if it is below 1e-14 of the largest eigenvalue
/// possible, so that a ball that was turned keeps the axes of the world.

#pragma once

#include <openvdb/Types.h>
#include <openvdb/math/Mat3.h>

namespace openvdb_spheretree::detail {

struct PrincipalAxes {
    openvdb::Vec3d moments; ///< ascending
    openvdb::Mat3d axes;    ///< a row is the unit vector of a moment; right-handed
};

/// @param matrix  symmetric and finite
/// @return its eigenvalues, correct to about 1e-14 of the largest. Moments that are equal but for
///         that come in the order of x, y, z as far as they are the axes. The largest coordinate of
///         the first two vectors, or the first of those as large, is positive.
PrincipalAxes principalAxes(const openvdb::Mat3d& matrix);

} // namespace openvdb_spheretree::detail
