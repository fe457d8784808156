// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/search/CoverGoal.h>

#include "support/FineBalls.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

bool holdsVoxels(const ExactSphere& ball, const Voxels& voxels)
{
    return std::all_of(
        voxels.begin(), voxels.end(), [&](const Coord& v) { return holds(ball, v); });
}

/// Held as a whole by one of them that is in the group.
bool anyHolds(const std::vector<CoverBall>& balls, const Voxels& voxels, int32_t group)
{
    return std::any_of(balls.begin(), balls.end(), [&](const CoverBall& ball) {
        return !ball.empty() && ball.group == group && holdsVoxels(ball.ball, voxels);
    });
}

constexpr int32_t kGroups = 3;

struct Unit {
    Voxels voxels;
    std::vector<int32_t> groups; ///< in which it counts
};

/// Units that the removed balls hold and no other, all together.
Voxels uncovered(const std::vector<Unit>& units, const std::vector<CoverBall>& removed,
    const std::vector<CoverBall>& others)
{
    Voxels all;
    for (const Unit& unit : units) {
        const auto held = [&](const std::vector<CoverBall>& balls) {
            return std::any_of(unit.groups.begin(), unit.groups.end(),
                [&](int32_t group) { return anyHolds(balls, unit.voxels, group); });
        };
        if (unit.voxels.empty() || !held(removed) || held(others)) continue;
        all.insert(all.end(), unit.voxels.begin(), unit.voxels.end());
    }
    sortVoxels(all);
    return all;
}

std::vector<CoverBall> randomCover(int count, int groups, Random& random)
{
    std::vector<CoverBall> balls;
    for (const ExactSphere& ball : randomBalls(count, random, 0, 16, 9)) {
        balls.push_back({ball, int32_t(random.between(0, groups - 1))});
    }
    return balls;
}

/// Regions of all groups, and each voxel with the groups that have it.
std::vector<Unit> regionUnits(const Voxels& voxels, const SampledObject& object, Random& random,
    std::vector<VoxelRegion>& regions)
{
    const auto clips = randomBalls(kGroups, random, 2, 14, 12);
    for (const ExactSphere& clip : clips) regions.push_back(regionOf(clip, object.level(0)));
    std::vector<Unit> units;
    for (const Coord& v : voxels) {
        units.push_back({{v}, {}});
        for (int32_t g = 0; g < kGroups; ++g) {
            if (holds(clips[g], v)) units.back().groups.push_back(g);
        }
    }
    return units;
}

TEST(CoverGoal, IsWhatOnlyTheLiftedBallsHold)
{
    Random random(1);
    int some = 0, someInGroups = 0;
    for (int turn = 0; turn < 300; ++turn) {
        const Voxels voxels = shapes::noise(Coord(18, 12, 14), 0.4, random);
        const SampledObject object = sampled(voxels);
        std::vector<VoxelRegion> regions;
        const auto inRegions = regionUnits(voxels, object, random, regions);
        std::vector<Unit> alone, units;
        for (const Coord& v : voxels) alone.push_back({{v}, {0, 1, 2}});
        std::vector<Voxels> unitVoxels;
        for (int i = 0; i < 30; ++i) {
            unitVoxels.push_back(translated(shapes::box(random.coord(1, 4)), random.coord(0, 12)));
            units.push_back({unitVoxels.back(), {0, 1, 2}});
        }
        unitVoxels.emplace_back(); // a unit of nothing
        const auto removed = randomCover(1 + turn % 2, 2, random);
        auto others = randomCover(turn % 4, kGroups, random);
        others.emplace_back();         // one that was dropped
        Voxels points{Coord(1, 1, 1)}; // to be forgotten
        VoxelGoal(object.level(0)).collectUncovered(removed, others, points);
        ASSERT_TRUE(standFor(points, uncovered(alone, removed, others), random));
        VoxelGoal(object.level(0), regions).collectUncovered(removed, others, points);
        ASSERT_TRUE(standFor(points, uncovered(inRegions, removed, others), random));
        someInGroups += !points.empty();
        UnitGoal(unitVoxels).collectUncovered(removed, others, points);
        ASSERT_TRUE(standFor(points, uncovered(units, removed, others), random));
        some += !points.empty();
    }
    EXPECT_GT(some, 50);
    EXPECT_GT(someInGroups, 50);
}

TEST(CoverGoal, IsHeldByBallsThatHoldEveryPoint)
{
    EXPECT_FALSE(holdsAll(ExactSphere(), {}));
    EXPECT_TRUE(holdsAll(voxelBall(Coord(1, 2, 3)), {}));
    EXPECT_TRUE(holdsAll({{0, 0, 0}, 256}, {Coord(0, 0, 1), Coord(-1, 0, 0)}));
    EXPECT_FALSE(holdsAll({{0, 0, 0}, 255}, {Coord(0, 0, 0), Coord(-1, 0, 0)}));
}

} // namespace
