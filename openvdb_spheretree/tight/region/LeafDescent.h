// SPDX-License-Identifier: Apache-2.0
/// @file LeafDescent.h
/// @brief Finds the balls that matter in each leaf of the object, from the whole object downwards:
/// RegionHalving.h.
///
/// Cost: linear in the lists that the filter leaves. Most of that are the lists of the leaves.

#pragma once

#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <openvdb/Types.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace openvdb_spheretree::tight {

/// Appends to @a to those balls of @a from that matter in a box of voxels, in order. Called by
/// several threads.
using BallFilter = std::function<void(
    const openvdb::CoordBBox& box, const std::vector<int32_t>& from, std::vector<int32_t>& to)>;

/// Takes the balls of a leaf: called once for each leaf, for several at the same time.
using LeafBallsBody = std::function<void(std::size_t leaf, const std::vector<int32_t>& balls)>;

/// @param balls  the numbers of all balls; every list has them in this order
void forEachLeafWithBalls(const SampleLevel& object, std::vector<int32_t> balls,
    const BallFilter& filter, const LeafBallsBody& body,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::tight
