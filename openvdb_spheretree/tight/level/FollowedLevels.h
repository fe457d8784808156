// SPDX-License-Identifier: Apache-2.0
/// @file FollowedLevels.h
/// @brief The levels of one frame of a sequence become those of the next: spheres start where they
/// were.
///
/// Levels that are made without the frame before may be quite others, though the object has hardly
/// changed: of two covers that are about as good, a few voxels decide. So spheres would jump.
/// 1. A voxel without a chain goes to the ball of the finest level that is nearest. This ball and
///    its ancestors grow until they hold it. Now all voxels have chains.
/// 2. All balls are placed anew (PlacedLevels.h).
/// 3. They are taken if no level costs more by a seventh, counted on samples, than the one that is
///    made without the frame before, and if they have moved less (SphereTracks.h).
/// Levels whose balls are all of use, need no growth and cost no more than that stay as they are.
/// Where memory is too small for the regions of all balls, the levels made without the frame before
/// are taken.
///
/// Cost: that of placing levels anew, a search for the nearest ball for each voxel without a chain,
/// and two pairings of all spheres.

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"
#include <openvdb_spheretree/tree/SphereTree.h>

#include <vector>

namespace openvdb_spheretree::tight {

/// @param last   the tree of the frame before. A body that only moves, by whole voxels, is followed
///               where it goes.
/// @param tree   of this frame, without nodes
/// @param fresh  levels of @a tree, made without @a last
/// @return levels of no more balls, or @a fresh: also where @a last has other levels, or voxels of
///         another size, or is somewhere else.
std::vector<TightLevel> followedLevels(const SphereTree& last, const SphereTree& tree,
    const std::vector<TightLevel>& fresh, const LevelMaker& maker);

} // namespace openvdb_spheretree::tight
