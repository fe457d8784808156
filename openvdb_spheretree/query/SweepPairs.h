// SPDX-License-Identifier: Apache-2.0
/// @file SweepPairs.h
/// @brief Pairs of spheres that are near each other, of many: sweep and prune.
///
/// Along the axis on which their centers spread most, the spheres are intervals; these are sorted by where they begin, and
/// swept (D. Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies", 1992, without his coherence in time). Pairs that
/// overlap there are compared as spheres. O(n log n) of n spheres, and the pairs that overlap along the axis.

#pragma once

#include <openvdb/Types.h>

#include <utility>
#include <vector>

namespace openvdb_spheretree::detail {

/// What doubles may be off by in a pose and in comparisons of places, a part of the lengths in them: a dozen roundings of
/// 2^-53, and room to spare.
constexpr double kPlaceRounding = 1.0 / (1ll << 48);

/// The object of a body is inside, in the world, and its leaf spheres where QueryTree::holdsLeaves().
struct BodySphere {
    int body;
    openvdb::Vec3d center;
    double radius; ///< with what rounding may have moved it by
};

/// @param spheres  at most one a body
/// @return the two bodies of each pair that is within @a margin, the smaller number first: no others can be. Sorted.
std::vector<std::pair<int, int>> sweepPairs(std::vector<BodySphere> spheres, double margin);

} // namespace openvdb_spheretree::detail
