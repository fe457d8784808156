// SPDX-License-Identifier: Apache-2.0
/// @file LevelCounts.h
/// @brief How many balls the levels of a tight tree get: what the budget says, or the fewest whose
/// exact error is within a bound.

#pragma once

#include <openvdb_spheretree/tree/SphereTreeSettings.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace openvdb_spheretree::tight {

/// What the bounds of a budget are held against: figures of stored spheres, or of unpadded ones.
struct BoundedError {
    double hammingPercent = 0;
    double reachWorld = 0; ///< out of the object, world units
    std::string unknown;   ///< why it is not known: then it is within no bound
};

/// Returns the exact error of a cover with so many balls, or of a cut of merges.
using ErrorOfCut = std::function<BoundedError(int64_t count)>;

/// @return whether an error is within the bounds of the budget; @a voxelSize is in world units.
bool isWithin(const SphereBudget& budget, double voxelSize, const BoundedError& error);

/// A stored sphere that holds the object's last voxel center along an axis reaches beyond it by the
/// padding, at least; the solid ends half a voxel behind that center.
/// @throw openvdb::ValueError if the padding alone reaches farther than the bound on the distance
void requireReachable(const SphereTreeSettings& settings, double voxelSize);

/// @param settings   of a tight tree
/// @param leafBalls  how many there are
/// @param voxelSize  world units
/// @return counts, finest first, falling. With a bound on the error, the first one is the smallest
/// for which the bound was found to hold. Counts are doubled from 1 on until it holds, then halved
/// between, and a few below are tried: fewer balls may have a smaller error. That of all leaf
/// balls, too, need not be the smallest, where their padding counts.
/// @throw openvdb::ValueError if the bound needs more balls than the budget allows, or none was
/// found within it, with what was found
std::vector<int64_t> levelCounts(const SphereTreeSettings& settings, int64_t leafBalls,
    double voxelSize, const ErrorOfCut& errorOf);

} // namespace openvdb_spheretree::tight
