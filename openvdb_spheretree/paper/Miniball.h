// SPDX-License-Identifier: Apache-2.0
/// @file Miniball.h
/// @brief The smallest ball that encloses balls, in floating point.
///
/// The center minimises the farthest reach |c - c_i| + r_i, and at most four balls decide where it
/// is. As in K. Fischer and B. Gaertner, "The smallest enclosing ball of balls: combinatorial
/// structure and algorithms", SoCG 2003, this is a problem of LP type, solved by pivots:
/// 1. find the ball that reaches farthest from the present center;
/// 2. find the smallest ball around it and those that decided so far (`deciding`): of the balls
///    tangent to each subset, the one from whose center none of these reaches far;
/// 3. repeat while the radius grows. Welzl's recursion, which would need no search of subsets, is
///    wrong for balls of different sizes.
///
/// Approximate: a relative error of some 1e-12 in radius; who needs a guarantee measures the reach
/// from the center exactly. Cost: some ten passes over the balls. Tests: TestMiniball.cc, against a
/// search of all subsets of the input, and a descent.

#pragma once

#include <openvdb/Types.h>

#include <vector>

namespace openvdb_spheretree::detail {

struct RealBall {
    openvdb::Vec3d center;
    double radius;
};

/// @param balls  one or more. Positions are best relative to somewhere near: errors grow with them.
RealBall miniball(const std::vector<RealBall>& balls);

} // namespace openvdb_spheretree::detail
