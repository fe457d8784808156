// SPDX-License-Identifier: Apache-2.0
/// @file BallPruning.h
/// @brief A cover without the balls whose voxels all lie in others: of medial balls, the leaf balls
/// of a tight tree.
///
/// Balls are tested one after the other, the smallest first. A ball is dropped if each of its
/// voxels is in another ball that is still there. What is left covers the object, and every ball
/// has a voxel of its own. Of medial balls less than half are left (Al.100: 1762 of 4127).
///
/// A ball is tested while all later ones are still there. So a voxel can make a ball necessary only
/// if no later ball holds it, and no earlier one that was kept.
/// 1. For each voxel, find the last ball that holds it: all leaves in parallel (RegionHalving.h).
/// 2. In order, keep a ball if a voxel that it is the last to hold is in no ball kept before.
///
/// Cost: near-linear in the balls, and in the leaves that kept balls reach. (To count the balls
/// that hold each voxel, and to take balls out one by one, took 5.4 s for dragon-512 in place of
/// 0.8 s, most of it not in parallel.)

#pragma once

#include <openvdb_spheretree/sphere/ExactSphere.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree::tight {

/// @param cover  balls that cover @a object; what they hold beside it does not count
/// @return the indices of the balls to keep, ascending.
std::vector<int32_t> prunedBalls(std::vector<ExactSphere> cover, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::tight
