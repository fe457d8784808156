// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/region/PowerCells.h>

#include "support/ChosenObjects.h"
#include "support/FineBalls.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// The cell of each ball, voxel by voxel.
std::vector<Voxels> naiveCells(const std::vector<ExactSphere>& balls, const Voxels& voxels)
{
    std::vector<Voxels> cells(balls.size());
    for (const Coord& v : voxels) {
        int64_t best = -1;
        std::size_t label = 0;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            int64_t power = balls[i].radiusSq;
            for (int a = 0; a < 3; ++a) {
                const int64_t d = 16 * int64_t(v[a]) - balls[i].center[a];
                power -= d * d;
            }
            const bool wins = power > best
                || (power == best && power >= 0 && balls[i].radiusSq > balls[label].radiusSq);
            if (wins) label = i;
            best = std::max(best, power);
        }
        if (best >= 0) cells[label].push_back(v);
    }
    return cells;
}

void expectCells(const std::vector<ExactSphere>& balls, const Voxels& voxels, Random& random)
{
    const auto points = powerCellPoints(balls, sampled(voxels).level(0), nullptr);
    const auto cells = naiveCells(balls, voxels);
    ASSERT_EQ(points.size(), cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        ASSERT_TRUE(standFor(points[i], cells[i], random)) << "ball " << i;
    }
}

TEST(PowerCells, OfLeavesAreTheVoxelsTheyCoverBest)
{
    Random random(1);
    for (const RandomObject& object : objectsOfAtMost(600, 200, 244, 30)) {
        std::vector<ExactSphere> balls;
        for (const auto& ball : CoreStages(*maskOf(object.voxels)).balls) {
            balls.push_back(fineBall(ball));
        }
        ASSERT_NO_FATAL_FAILURE(expectCells(balls, object.voxels, random)) << object.name;
    }
}

/// Balls that reach out of the object, some of them twice.
TEST(PowerCells, OfAnyBallsAreTheVoxelsTheyCoverBestWithEveryTarget)
{
    forEachTarget([] {
        Random random(2);
        for (int turn = 0; turn < 30; ++turn) {
            auto balls = randomBalls(random.between(1, 30), random, -10, 25, 12);
            balls.push_back(balls.front());
            const Voxels voxels = shapes::noise(Coord(17, 12, 14), 0.3, random);
            ASSERT_NO_FATAL_FAILURE(expectCells(balls, voxels, random));
        }
    });
}

} // namespace
