// SPDX-License-Identifier: Apache-2.0
#include "PowerTree.h"

#include "RegionHalving.h"
#include <openvdb_spheretree/base/IntegerRoot.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace openvdb_spheretree::detail {

using openvdb::Coord;

PowerSearch::PowerSearch(std::vector<MedialBall> balls) : mBalls(std::move(balls))
{
    mOrder.resize(mBalls.size());
    std::iota(mOrder.begin(), mOrder.end(), 0);
    build(0, int32_t(mOrder.size()));
}

/// Halves the range each time: at most 31 deep.
void PowerSearch::build(int32_t begin, int32_t end)
{
    const std::size_t self = mNodes.size();
    Node node;
    node.begin = begin;
    node.end = end;
    for (int32_t i = begin; i < end; ++i) {
        const MedialBall& ball = mBalls[mOrder[i]];
        node.box.expand(ball.center);
        node.largestSq = std::max(node.largestSq, int64_t(ball.radiusSq));
    }
    mNodes.push_back(node);
    if (end - begin <= kMostInLeaf) return;
    const int axis = longestAxis(node.box);
    const int32_t middle = begin + (end - begin) / 2;
    const auto before = [&](int32_t a, int32_t b) {
        const int32_t x = mBalls[a].center[axis], y = mBalls[b].center[axis];
        return x != y ? x < y : a < b;
    };
    std::nth_element(mOrder.begin() + begin, mOrder.begin() + middle, mOrder.begin() + end, before);
    build(begin, middle);
    mNodes[self].second = int32_t(mNodes.size());
    build(middle, end);
}

int64_t PowerSearch::leastPower(const Node& node, const Coord& voxel)
{
    int64_t sum = -node.largestSq;
    for (int axis = 0; axis < 3; ++axis) {
        const int64_t below = int64_t(node.box.min()[axis]) - voxel[axis];
        const int64_t above = int64_t(voxel[axis]) - node.box.max()[axis];
        sum += square(std::max<int64_t>(0, std::max(below, above)));
    }
    return sum;
}

void PowerSearch::search(int32_t at, const Coord& voxel, Found& best) const
{
    const Node& node = mNodes[at];
    if (node.second == 0) {
        for (int32_t i = node.begin; i < node.end; ++i) {
            const MedialBall& ball = mBalls[mOrder[i]];
            Found found{-int64_t(ball.radiusSq), mOrder[i]};
            for (int a = 0; a < 3; ++a) found.power += square(int64_t(ball.center[a]) - voxel[a]);
            const bool better =
                found.power < best.power || (found.power == best.power && found.ball < best.ball);
            if (better) best = found;
        }
        return;
    }
    std::pair<int64_t, int32_t> child[2] = {{leastPower(mNodes[at + 1], voxel), at + 1},
        {leastPower(mNodes[node.second], voxel), node.second}};
    if (child[1] < child[0]) std::swap(child[0], child[1]);
    for (const auto& [power, index] : child) {
        if (power <= best.power) search(index, voxel, best); // equals: one of lower index, maybe
    }
}

int32_t PowerSearch::nearest(const Coord& voxel) const
{
    Found best{INT64_MAX, -1};
    search(0, voxel, best);
    return best.ball;
}

} // namespace openvdb_spheretree::detail
