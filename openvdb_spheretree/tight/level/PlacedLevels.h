// SPDX-License-Identifier: Apache-2.0
/// @file PlacedLevels.h
/// @brief Levels with chains whose balls are larger than they need be: all are placed anew, and the
/// chains stay.
///
/// Finest level first, each ball is placed anew for those voxels in its ancestors that no other
/// ball of the level holds; above the finest level, only for those of them that its children hold.
///
/// Cost: two or three passes over the voxels in the balls of each level.

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// @param levels  finest first: every voxel has a chain
/// @param most    balls of the finest level: if more are left when all are placed, they are merged
///                to so many
/// @param spare   a cover. Of the finest level, balls that no voxel needs move to places of these;
///                if there are none, such balls are dropped.
/// @return the levels, without balls that no chain needs.
/// @throw openvdb::ValueError if they need more memory than the maker may take
std::vector<TightLevel> placedLevels(std::vector<TightLevel> levels, int64_t most,
    const LevelMaker& maker, const std::vector<ExactSphere>& spare = {});

} // namespace openvdb_spheretree::tight
