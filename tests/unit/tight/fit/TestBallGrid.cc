// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/fit/BallGrid.h>

#include "support/FineBalls.h"

#include <map>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

using Balls = std::map<int32_t, ExactSphere>;

std::vector<int32_t> linearNear(const Balls& balls, const ExactSphere& ball, double slack)
{
    std::vector<int32_t> ids;
    for (const auto& [id, other] : balls) {
        if (gapBetween(other, ball) <= slack) ids.push_back(id);
    }
    return ids;
}

std::vector<int32_t> linearMeeting(const Balls& balls, const FineBox& box)
{
    std::vector<int32_t> ids;
    for (const auto& [id, ball] : balls) {
        const auto reach = int64_t(std::ceil(ball.radius()));
        bool meets = true;
        for (int a = 0; a < 3; ++a) {
            meets =
                meets && ball.center[a] + reach >= box.lo[a] && ball.center[a] - reach <= box.hi[a];
        }
        if (meets) ids.push_back(id);
    }
    return ids;
}

std::vector<int32_t> linearNearest(const Balls& balls, int32_t id, std::size_t count)
{
    const ExactSphere& ball = balls.at(id);
    std::vector<std::pair<double, int32_t>> found;
    for (const auto& [other, b] : balls) {
        if (other == id) continue;
        found.emplace_back(gapBetween(b, ball) / (std::min(b.radius(), ball.radius()) + 16), other);
    }
    std::sort(found.begin(), found.end());
    std::vector<int32_t> ids;
    for (std::size_t i = 0; i < std::min(count, found.size()); ++i) ids.push_back(found[i].second);
    return ids;
}

void expectSame(const BallGrid& grid, const Balls& balls, Random& random)
{
    ASSERT_EQ(grid.size(), balls.size());
    for (int i = 0; i < 6; ++i) {
        const ExactSphere ball = randomBall(random, -60, 60, 1 << i);
        for (const double slack : {0.0, 100.0, -20.0}) {
            ASSERT_EQ(grid.near(ball, slack), linearNear(balls, ball, slack));
        }
        FineBox box;
        box.expand(ball, 5);
        ASSERT_EQ(grid.meeting(box), linearMeeting(balls, box));
    }
    for (const auto& [id, ball] : balls) {
        const auto count = std::size_t(random.between(0, 9));
        ASSERT_EQ(grid.nearest(id, ball, count), linearNearest(balls, id, count));
    }
}

TEST(BallGrid, FindsWhatALinearScanFinds)
{
    Random random(1);
    for (const int spread : {6, 40, 3000, 1 << 24}) {
        BallGrid grid;
        Balls balls;
        for (int turn = 0; turn < 160; ++turn) {
            if (!balls.empty() && random.chance(0.3)) {
                const auto at = std::next(balls.begin(), random.between(0, int(balls.size()) - 1));
                grid.remove(at->first, at->second);
                balls.erase(at);
            } else {
                balls[turn] = randomBall(random, -spread, spread, 1 << random.between(0, 6));
                grid.add(turn, balls[turn]);
            }
            if (turn % 10 != 9) continue;
            ASSERT_NO_FATAL_FAILURE(expectSame(grid, balls, random)) << spread;
        }
    }
}

TEST(BallGrid, FindsTheOnlyOtherBallHoweverFar)
{
    BallGrid grid;
    const ExactSphere here = voxelBall(Coord(0, 0, 0)), there = voxelBall(Coord(1 << 25, 5, 5));
    grid.add(0, here);
    EXPECT_TRUE(grid.nearest(0, here, 3).empty());
    EXPECT_EQ(grid.nearest(1, there, 3), std::vector<int32_t>{0}) << "not in the grid itself";
    grid.add(1, there);
    EXPECT_EQ(grid.nearest(0, here, 3), std::vector<int32_t>{1});
}

} // namespace
