// SPDX-License-Identifier: Apache-2.0
/// @file tight/LeafPruning.h
/// @brief The leaves of a tight tree: medial balls of the object, without those whose voxels all lie
/// in others.
///
/// Smallest first, each ball is dropped if every one of its voxels is held by another ball that is
/// still there. What is left rebuilds the object exactly, with less than half of the balls (Al.100:
/// 1762 of 4127), and every ball has a voxel of its own.
///
/// Cost: linear in the leaves that the balls reach into. Most of the balls that stay are found in
/// parallel: one that has a voxel of its own keeps it, whatever else is dropped.

#pragma once

#include "../MedialAxis.h"
#include "FineBall.h"
#include "SampledObject.h"

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
