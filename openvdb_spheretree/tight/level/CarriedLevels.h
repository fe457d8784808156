// SPDX-License-Identifier: Apache-2.0
/// @file CarriedLevels.h
/// @brief The levels of a coarse object become levels of the next finer one in its pyramid.
///
/// Large balls lose little where they are decided on a coarse level of the pyramid, and that takes
/// a small part of the time. (dragon-512: 64 balls found at a quarter of the resolution are better
/// than those that merging finds on all of it.)
/// 1. Each ball grows until it holds the children of all voxels that it holds (lifted()). So chains
///    stay.
/// 2. All are placed anew (PlacedLevels.h).

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"
#include <openvdb_spheretree/pyramid/PyramidModel.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// @param step  from the finer level of the pyramid to that of the ball; its factor is 2
/// @return a ball that holds the children of every voxel in @a ball.
ExactSphere lifted(const ExactSphere& ball, const PyramidStep& step);

/// @param levels  finest first, of the coarse object
/// @param step    from the finer object to the coarse one
/// @param most    balls of the finest level: if more are left when all are placed, they are merged
///                to so many. On the way down some are no longer needed, so begin with more than
///                are asked for.
/// @param finer   for the finer object
std::vector<TightLevel> carriedDown(
    std::vector<TightLevel> levels, const PyramidStep& step, int64_t most, const LevelMaker& finer);

} // namespace openvdb_spheretree::tight
