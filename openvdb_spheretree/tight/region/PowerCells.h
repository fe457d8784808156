// SPDX-License-Identifier: Apache-2.0
/// @file PowerCells.h
/// @brief The object cut into the power cells of given balls.
///
/// A voxel is in the power cell of the ball with the largest power there, radiusSq - distance^2; of
/// equals, of the larger ball, then of the first. (PowerMap.h finds such labels among all medial
/// balls, here they are few.)
///
/// The difference of two powers is linear. So a ball with less power than another one at all
/// corners of a box has less in all of the box, and is left out there and in its parts
/// (RegionHalving.h). With dragon-512 that took a quarter of the time.

#pragma once

#include "VoxelRegion.h"
#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree::tight {

/// @param balls    that cover @a object
/// @param regions  of each ball: the voxels that may be in its cell; together the object
/// @return the power cell of each ball.
std::vector<VoxelRegion> powerCells(const std::vector<ExactSphere>& balls,
    const std::vector<VoxelRegion>& regions, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter);

/// @return the power cell of each ball, if any voxel may be in it.
std::vector<VoxelRegion> powerCells(const std::vector<ExactSphere>& balls,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter);

/// @return the extreme points of each region: ExtremePoints.h; none of an empty one.
std::vector<std::vector<openvdb::Coord>> extremePoints(const std::vector<VoxelRegion>& regions,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter);

/// @param balls  that cover @a object
/// @return the extreme points of each ball's power cell.
std::vector<std::vector<openvdb::Coord>> powerCellPoints(const std::vector<ExactSphere>& balls,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::tight
