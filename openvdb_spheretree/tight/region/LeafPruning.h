// SPDX-License-Identifier: Apache-2.0
/// @file LeafPruning.h
/// @brief The leaves of a tight tree: medial balls of the object, without those whose voxels all
/// lie in others.
///
/// Smallest first, each ball is dropped if every one of its voxels is held by another ball that is
/// still there. What is left rebuilds the object exactly, with less than half of the balls (Al.100:
/// 1762 of 4127), and every ball has a voxel of its own.
///
/// A voxel can only be what keeps the last of the balls that hold it: an earlier ball is not alone
/// there. So each voxel has one ball that may need it, and a ball is kept if one of its voxels is
/// in no ball that was kept before:
/// 1. which ball is the last one of which voxel: all leaves in parallel (LeafDescent.h);
/// 2. in order, is one of a ball's voxels left, and if so, what does the ball hold.
///
/// Cost: near-linear in the balls, and in the leaves that reach into balls that are kept. (Counts
/// of the balls that hold each voxel, and taking balls out one by one, cost 5.4 s for dragon-512
/// in place of 0.8 s, most of it not in parallel.)

#pragma once

#include <openvdb_spheretree/medial/MedialAxis.h>
#include <openvdb_spheretree/tight/fit/FineBall.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree {
namespace tight {

/// @param balls  whose union is @a object
/// @return the indices of the balls to keep, ascending.
std::vector<int32_t> prunedLeaves(const std::vector<MedialBall>& balls, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter);

} // namespace tight
} // namespace openvdb_spheretree
