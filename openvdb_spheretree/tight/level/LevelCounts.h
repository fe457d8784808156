// SPDX-License-Identifier: Apache-2.0
/// @file LevelCounts.h
/// @brief How many balls the levels of a tight tree get: what the budget says, or the fewest whose
/// exact error is within a bound.

#pragma once

#include <openvdb_spheretree/tree/SphereBudget.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <functional>
#include <vector>

namespace openvdb_spheretree::tight {

/// Returns the exact error of the cut with so many balls.
using ErrorOfCut = std::function<LevelError(int64_t count)>;

/// @return whether an error is within the bounds of the budget; @a voxelSize is in world units.
bool isWithin(const SphereBudget& budget, double voxelSize, const LevelError& error);

/// @param leafBalls  how many there are
/// @param voxelSize  world units
/// @return counts, finest first, falling. With a bound on the error, the first one is the smallest for
/// which the bound was found to hold: by bisection, and then by a few tries below, since a cut of fewer
/// balls may have a smaller error.
/// @throw openvdb::ValueError if the bound needs more balls than the budget allows
std::vector<int64_t> levelCounts(
    const SphereBudget& budget, int64_t leafBalls, double voxelSize, const ErrorOfCut& errorOf);

} // namespace openvdb_spheretree::tight
