// SPDX-License-Identifier: Apache-2.0
/// @file InnerOrder.h
/// @brief An object's medial balls in a greedy order: the first N of it are the inner balls for N.
///
/// 1. Candidates are the medial balls of the object (MedialAxis.h): nearly all balls inside the
///    object that no other such ball holds.
/// 2. Each step takes the ball that holds the most uncovered voxels; of equals the larger, then the
///    one whose center is first in the order of Coord. One order serves every N: its first N balls
///    cover at least 1 - 1/e of what the best N candidates cover (G. L.
///    Nemhauser, L. A. Wolsey, M. L. Fisher, "An analysis of approximations for maximizing
///    submodular set functions", 1978).
/// 3. It ends when all is covered: with a sixth of the medial balls of dragon-512, and five sixths
///    of hairball-256's.
///
/// What a ball adds only falls as others are taken. So it is counted again only when it comes to
/// the top of a queue (M. Minoux, "Accelerated greedy algorithms for maximizing submodular set
/// functions", 1978), and then only if a leaf that it reaches into has changed. The next balls in the
/// queue are counted with it, in parallel. That changes no choice.
///
/// Exact: strictly the greedy order, for any number of threads. Cost: see innerOrder(). Tests:
/// TestInnerTree.cc, against a greedy search that counts everything anew.

#pragma once

#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/MedialBall.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

class LeafLayout;

namespace detail {

struct InnerOrder {
    std::vector<int32_t> ball;    ///< indices of the balls, in the order they are taken
    std::vector<int64_t> covered; ///< of each: voxels that it and those before it cover together
};

/// @param layout  the object's voxels
/// @param balls   their medial balls, or any others inside the object; ordered by center
/// @param dim     2 if the object is one voxel thick along z
/// @param most    ends after so many balls
/// @throw Interrupted if @a interrupter (which may be null) said so
/// @note A ball is counted several times, each time at a cost linear in the leaves (8x8x8) that it
///       reaches into. Of dragon-512 (7.4 million voxels, 138,157 balls) 878,000 counts take 4.5 s
///       of processor time, of hairball-256 (898,764 balls) 4.4 s.
InnerOrder innerOrder(const LeafLayout& layout, const std::vector<MedialBall>& balls, int dim = 3,
    int64_t most = INT64_MAX, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return the balls of the order, in the index space of an object that was turned to be flat along z.
std::vector<MedialBall> ballsInOrder(
    const std::vector<MedialBall>& balls, const InnerOrder& order, const FlatAxis& flat);

} // namespace detail
} // namespace openvdb_spheretree
