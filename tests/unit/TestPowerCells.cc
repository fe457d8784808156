// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/PowerCells.h>

#include "../support/FineBalls.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

int64_t powerOf(const FineBall& ball, const Coord& v)
{
    int64_t power = ball.radiusSq;
    for (int a = 0; a < 3; ++a) {
        const int64_t d = 16 * int64_t(v[a]) - ball.center[a];
        power -= d * d;
    }
    return power;
}

std::vector<Voxels> naiveCells(const std::vector<FineBall>& balls, const Voxels& voxels)
{
    std::vector<Voxels> cells(balls.size());
    for (const Coord& v : voxels) {
        std::size_t best = 0;
        for (std::size_t i = 1; i < balls.size(); ++i) {
            const int64_t mine = powerOf(balls[i], v), most = powerOf(balls[best], v);
            const bool larger = balls[i].radiusSq > balls[best].radiusSq;
            if (mine > most || (mine == most && larger)) best = i;
        }
        cells[best].push_back(v);
    }
    return cells;
}

/// Centres on every eighth or half of a voxel, so that there are ties.
std::vector<FineBall> coarseBalls(Random& random)
{
    auto balls = randomBalls(random.between(1, 40), random, -24, 24, random.between(3, 20));
    const int64_t mask = random.between(0, 1) ? ~int64_t(7) : ~int64_t(127);
    for (FineBall& ball : balls) {
        for (int64_t& c : ball.center) c &= mask;
    }
    return balls;
}

TEST(PowerCells, AreOfTheBallThatCoversAVoxelBest)
{
    Random random(1);
    for (int i = 0; i < 60; ++i) {
        const auto balls = coarseBalls(random);
        Voxels voxels;
        for (int at = 0; at < 64 * 64 * 64; ++at) {
            const Coord v((at >> 12) - 32, (at >> 6 & 63) - 32, (at & 63) - 32);
            const auto has = [&](const FineBall& ball) { return holds(ball, v); };
            if (std::any_of(balls.begin(), balls.end(), has)) voxels.push_back(v);
        }
        if (voxels.empty()) continue;
        const auto expected = naiveCells(balls, voxels);
        const auto points = cellPoints(balls, sampled(voxels).level(0), nullptr);
        ASSERT_EQ(points.size(), balls.size());
        for (std::size_t ball = 0; ball < balls.size(); ++ball) {
            ASSERT_TRUE(standFor(points[ball], expected[ball], random)) << i << ", " << ball;
        }
    }
}

} // namespace
