// SPDX-License-Identifier: Apache-2.0
/// @file ChildMoves.h
/// @brief Children of a level move to other parents, as long as that lowers the cost.
///
/// In a trial, the old parent is placed anew without the child, the new one grows around it and is
/// placed anew. Each must hold those voxels of its children's regions that no other parent holds
/// for children of its own. A round tries every child with the parents next to it, all from the
/// same state and in parallel. Then it makes the moves that pay one after the other, the best
/// first; one whose surroundings meet those of a move that was made is tried again before. The next
/// round tries those that gained nothing again where one of their two balls has changed. A child
/// moves twice at most: some would go to and fro.

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// @param balls    of the coarser level; together they hold what is in their children's regions
/// @param finer    the children, whose parents may change
/// @param regions  of the children
void moveChildren(std::vector<ExactSphere>& balls, TightLevel& finer,
    const std::vector<VoxelRegion>& regions, const LevelMaker& maker);

} // namespace openvdb_spheretree::tight
