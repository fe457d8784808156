// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/CoverDebt.h>

#include "../support/FineBalls.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

bool holdsVoxels(const FineBall& ball, const Voxels& voxels)
{
    return std::all_of(
        voxels.begin(), voxels.end(), [&](const Coord& v) { return holds(ball, v); });
}

/// Held as a whole by one of them.
bool anyHolds(const std::vector<FineBall>& balls, const Voxels& voxels)
{
    return std::any_of(balls.begin(), balls.end(),
        [&](const FineBall& ball) { return !ball.empty() && holdsVoxels(ball, voxels); });
}

/// Units that the lifted balls hold and no other, all together.
Voxels owed(const std::vector<Voxels>& units, const std::vector<FineBall>& lifted,
    const std::vector<FineBall>& others)
{
    Voxels all;
    for (const Voxels& unit : units) {
        if (unit.empty() || !anyHolds(lifted, unit) || anyHolds(others, unit)) continue;
        all.insert(all.end(), unit.begin(), unit.end());
    }
    sortVoxels(all);
    return all;
}

TEST(CoverDebt, IsWhatOnlyTheLiftedBallsHold)
{
    Random random(1);
    int some = 0;
    for (int turn = 0; turn < 300; ++turn) {
        const Voxels voxels = shapes::noise(Coord(18, 12, 14), 0.4, random);
        const SampledObject object = sampled(voxels);
        std::vector<Voxels> alone, blocks;
        for (const Coord& v : voxels) alone.push_back({v});
        for (int i = 0; i < 30; ++i) {
            blocks.push_back(translated(shapes::box(random.coord(1, 4)), random.coord(0, 12)));
        }
        blocks.emplace_back(); // a unit of nothing
        const auto lifted = randomBalls(1 + turn % 2, random, 0, 16, 9);
        auto others = randomBalls(turn % 4, random, 0, 16, 9);
        others.emplace_back();         // one that was dropped
        Voxels points{Coord(1, 1, 1)}; // to be forgotten
        VoxelDebt(object.level(0)).collect(ungrouped(lifted), ungrouped(others), points);
        ASSERT_TRUE(standFor(points, owed(alone, lifted, others), random));
        UnitDebt(blocks).collect(ungrouped(lifted), ungrouped(others), points);
        ASSERT_TRUE(standFor(points, owed(blocks, lifted, others), random));
        some += !points.empty();
    }
    EXPECT_GT(some, 100);
}

TEST(CoverDebt, IsHeldByBallsThatHoldEveryPoint)
{
    EXPECT_FALSE(holdsAll(FineBall(), {}));
    EXPECT_TRUE(holdsAll(voxelBall(Coord(1, 2, 3)), {}));
    EXPECT_TRUE(holdsAll({{0, 0, 0}, 256}, {Coord(0, 0, 1), Coord(-1, 0, 0)}));
    EXPECT_FALSE(holdsAll({{0, 0, 0}, 255}, {Coord(0, 0, 0), Coord(-1, 0, 0)}));
}

} // namespace
