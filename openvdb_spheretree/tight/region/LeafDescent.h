// SPDX-License-Identifier: Apache-2.0
/// @file LeafDescent.h
/// @brief Which balls matter in which leaf of the object, found from the whole of it downwards:
/// RegionHalving.h.
///
/// Cost: the balls in the lists that the filter leaves; those of the leaves are most of them.

#pragma once

#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <openvdb/Types.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace openvdb_spheretree {
namespace tight {

/// Appends those of @a from that matter in a box of voxels to @a to, in order; called by several
/// threads.
using BallFilter = std::function<void(
    const openvdb::CoordBBox& box, const std::vector<int32_t>& from, std::vector<int32_t>& to)>;

/// Takes what is left for a leaf: called once for each leaf, for several at the same time.
using LeafBallsBody = std::function<void(std::size_t leaf, const std::vector<int32_t>& balls)>;

/// @param balls  the numbers of all balls, in the order in which lists have them
void forEachLeafWithBalls(const SampleLevel& object, std::vector<int32_t> balls,
    const BallFilter& filter, const LeafBallsBody& body,
    openvdb::util::NullInterrupter* interrupter);

} // namespace tight
} // namespace openvdb_spheretree
