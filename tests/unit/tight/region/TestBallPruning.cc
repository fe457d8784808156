// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/region/BallPruning.h>

#include "support/FineBalls.h"

#include <map>
#include <numeric>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

Voxels voxelsOf(const MedialBall& ball)
{
    return translated(shapes::ball(ball.radiusSq), ball.center);
}

/// One ball after the other, smallest first.
std::vector<int32_t> naivelyPruned(const std::vector<MedialBall>& balls)
{
    std::map<Coord, int> counts;
    for (const MedialBall& ball : balls) {
        for (const Coord& v : voxelsOf(ball)) ++counts[v];
    }
    std::vector<int32_t> order(balls.size()), kept;
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
        [&](int32_t a, int32_t b) { return balls[a].radiusSq < balls[b].radiusSq; });
    for (const int32_t i : order) {
        const Voxels voxels = voxelsOf(balls[i]);
        const bool needed = std::any_of(
            voxels.begin(), voxels.end(), [&](const Coord& v) { return counts[v] == 1; });
        if (needed) kept.push_back(i);
        for (const Coord& v : voxels) counts[v] -= !needed;
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

void expectPruned(const RandomObject& object)
{
    const CoreStages stages(*maskOf(object.voxels));
    const auto kept =
        prunedBalls(fineBalls(stages.balls), SampledObject(stages.layout).level(0), nullptr);
    ASSERT_EQ(kept, naivelyPruned(stages.balls)) << object.name;
    Voxels all;
    for (const int32_t i : kept) {
        for (const Coord& v : voxelsOf(stages.balls[i])) all.push_back(v);
    }
    sortVoxels(all);
    ASSERT_EQ(all, object.voxels) << object.name;
}

TEST(BallPruning, KeepsWhatPruningOneByOneKeeps)
{
    for (uint32_t seed = 0; seed < 55; ++seed) {
        ASSERT_NO_FATAL_FAILURE(expectPruned(randomObject(seed)));
    }
}

/// More balls than are asked at once.
TEST(BallPruning, KeepsWhatPruningOneByOneKeepsOfManyBalls)
{
    Random random(1);
    const RandomObject object{"noise", shapes::noise(Coord(40, 30, 20), 0.8, random)};
    ASSERT_GT(CoreStages(*maskOf(object.voxels)).balls.size(), 4096u);
    ASSERT_NO_FATAL_FAILURE(expectPruned(object));
}

/// The smallest ball holds all of a leaf, and is alone at its own center only.
TEST(BallPruning, KeepsABallForAVoxelInALeafThatItHolds)
{
    const Coord middle(4, 4, 4);
    std::vector<MedialBall> balls{{middle, 50}};
    for (const Coord& v : voxelsOfBox(CoordBBox(Coord(-8), Coord(8)))) {
        const int64_t square = squaredDistance(v, Coord(0, 0, 0));
        if (square >= 60 && square < 64) balls.push_back({middle + v, 60});
    }
    Voxels all;
    for (const MedialBall& ball : balls) {
        for (const Coord& v : voxelsOf(ball)) all.push_back(v);
    }
    sortVoxels(all);
    const auto kept = prunedBalls(fineBalls(balls), sampled(all).level(0), nullptr);
    ASSERT_EQ(kept.front(), 0);
    ASSERT_EQ(kept, naivelyPruned(balls));
}

TEST(BallPruning, OfNothingIsNothing)
{
    EXPECT_TRUE(prunedBalls({}, sampled({}).level(0), nullptr).empty());
}

} // namespace
