// SPDX-License-Identifier: Apache-2.0
/// @file PowerTree.h
/// @brief Which of many balls is nearest to a voxel by power distance, |q - c|^2 - radiusSq.
///
/// A k-d tree of the centers, split at the median of the widest axis. Each node has the box and the
/// largest radius below it: together they bound the power from below. Integers throughout. Of
/// equally near balls it is the one of lowest index. Cost: O(n log n) to build, about O(log n) a
/// search. Tests: TestInnerTree.cc. (A visit of BoundingTree finds the same in three to eight times the
/// time: what a ball around many balls says of their powers is weak.)

#pragma once

#include <openvdb_spheretree/voxel/MedialBall.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

class PowerSearch {
public:
    /// @param balls  one or more
    explicit PowerSearch(std::vector<MedialBall> balls);

    /// @return the index of the ball.
    int32_t nearest(const openvdb::Coord& voxel) const;

private:
    static constexpr int32_t kMostInLeaf = 8;

    struct Node {
        openvdb::CoordBBox box;
        int64_t largestSq = 0;
        int32_t begin = 0, end = 0; ///< of mOrder
        int32_t second = 0;         ///< the other child stands next; 0: a leaf
    };
    struct Found {
        int64_t power;
        int32_t ball;
    };

    void build(int32_t begin, int32_t end);
    void search(int32_t node, const openvdb::Coord& voxel, Found& best) const;
    static int64_t leastPower(const Node& node, const openvdb::Coord& voxel);

    std::vector<MedialBall> mBalls;
    std::vector<int32_t> mOrder;
    std::vector<Node> mNodes; ///< depth first
};

} // namespace openvdb_spheretree::detail
