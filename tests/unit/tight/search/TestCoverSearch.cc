// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/search/CoverSearch.h>

#include "support/Expectations.h"
#include "support/MergedLeaves.h"

#include <openvdb_spheretree/sphere/LeafVoxels.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

const FitEffort kEffort{true, 12, 1, false, 40};

bool anyHolds(const std::vector<ExactSphere>& balls, const Voxels& voxels)
{
    return std::any_of(balls.begin(), balls.end(), [&](const ExactSphere& ball) {
        return std::all_of(
            voxels.begin(), voxels.end(), [&](const Coord& v) { return holds(ball, v); });
    });
}

/// Starts from a cut of merged leaves.
struct Start : MergedLeaves {
    Start(const Voxels& voxels, int64_t count)
        : MergedLeaves(voxels, false, ::kEffort), balls(cut(count))
    {}
    std::vector<ExactSphere> balls;
};

/// @param units  each to be held by one ball
void expectBetter(const Start& start, const CoverGoal& goal, const std::vector<Voxels>& units)
{
    const SearchedCover found = improveCover(ungrouped(start.balls), ungrouped(start.leaves),
        start.object, goal, {kEffort, 30, 0, false}, nullptr);
    const auto balls = ballsOf(found.balls);
    ASSERT_EQ(balls.size(), start.balls.size());
    for (const ExactSphere& ball : balls) ASSERT_FALSE(ball.empty());
    for (const Voxels& unit : units) ASSERT_TRUE(anyHolds(balls, unit));
    const auto before = excess(start.balls, start.voxels), after = excess(balls, start.voxels);
    ASSERT_LE(after, before);
    ASSERT_EQ(found.change, double(after - before)); // small balls are not sampled
}

TEST(CoverSearch, KeepsACoverOfVoxelsAndIsNeverWorse)
{
    Random random(1);
    for (const int64_t count : {1, 2, 5, 9}) {
        const Start start(shapes::noise(Coord(8, 7, 7), 0.5, random), count);
        std::vector<Voxels> alone;
        for (const Coord& v : start.voxels) alone.push_back({v});
        const VoxelGoal goal(start.object.level(0));
        ASSERT_NO_FATAL_FAILURE(expectBetter(start, goal, alone)) << count;
    }
}

TEST(CoverSearch, KeepsACoverOfUnitsAndIsNeverWorse)
{
    Random random(2);
    for (const int64_t count : {1, 3, 6}) {
        const Start start(shapes::noise(Coord(8, 7, 7), 0.5, random), count);
        const auto units = powerCellPoints(start.balls, start.object.level(0), nullptr);
        ASSERT_NO_FATAL_FAILURE(expectBetter(start, UnitGoal(units), units)) << count;
    }
}

/// Six balls far apart, the last one of two voxels, and a cover whose first ball holds two of them.
struct Parted {
    std::vector<Voxels> parts;
    Voxels voxels;
    std::vector<ExactSphere> leaves, start;

    Parted()
    {
        for (int i = 0; i < 6; ++i) {
            const Voxels part = i < 5 ? shapes::ball(8) : shapes::box(Coord(1, 1, 2));
            parts.push_back(translated(part, Coord(14 * i, 0, 0)));
            voxels.insert(voxels.end(), parts.back().begin(), parts.back().end());
        }
        sortVoxels(voxels);
        for (const auto& ball : CoreStages(*maskOf(voxels)).balls) leaves.push_back(fineBall(ball));
        start.push_back({{16 * 7, 0, 0}, 160 * 160});
        for (int i = 2; i < 5; ++i) start.push_back({{16 * 14 * i, 0, 0}, 16 * 16 * 7});
        for (int z = 0; z < 2; ++z) start.push_back({{16 * 14 * 5, 0, 16 * z}, 0});
    }
};

/// @param trials  for each ball
void expectApart(const Parted& parted, const std::vector<ExactSphere>& start, int trials)
{
    const SampledObject object = sampled(parted.voxels);
    ASSERT_GT(excess(start, parted.voxels), 0);
    const SearchedCover found = improveCover(ungrouped(start), ungrouped(parted.leaves), object,
        VoxelGoal(object.level(0)), {kEffort, trials, 0, false}, nullptr);
    const auto balls = ballsOf(found.balls);
    ASSERT_EQ(balls.size(), parted.parts.size());
    for (const ExactSphere& ball : balls) ASSERT_FALSE(ball.empty());
    for (const Voxels& part : parted.parts) EXPECT_TRUE(anyHolds(balls, part));
    EXPECT_EQ(excess(balls, parted.voxels), 0);
    EXPECT_EQ(found.change, -double(excess(start, parted.voxels)));
}

TEST(CoverSearch, PutsABallThatNoVoxelNeedsWhereOneIsMissing)
{
    const Parted parted;
    std::vector<ExactSphere> start = parted.start;
    start[4] = {{16 * 14 * 5, 0, 8}, 8 * 8};
    start[5] = {{16 * 14 * 4, 0, 0}, 16 * 16};
    for (const int trials : {0, 5}) expectApart(parted, start, trials);
}

TEST(CoverSearch, TakesABallAwayWhereAnotherOneCanDo)
{
    const Parted parted;
    expectApart(parted, parted.start, 1);
}

TEST(CoverSearch, KeepsACoverWhereManyBallsChangeAtATime)
{
    Random random(4);
    for (const int64_t count : {20, 40}) {
        const Start start(shapes::noise(Coord(50, 5, 5), 0.5, random), count);
        std::vector<Voxels> alone;
        for (const Coord& v : start.voxels) alone.push_back({v});
        const VoxelGoal goal(start.object.level(0));
        ASSERT_NO_FATAL_FAILURE(expectBetter(start, goal, alone)) << count;
    }
}

/// Surroundings of balls that are near meet, so only some of these are placed at a time; the others wait for their turn.
TEST(CoverSearch, OneSweepPlacesAllBallsThoughTheirSurroundingsMeet)
{
    Voxels voxels;
    std::vector<ExactSphere> balls;
    for (int i = 0; i < 300; ++i) { // more than are looked at at a time
        voxels.push_back(Coord(2 * i, 0, 0));
        balls.push_back(voxelBall(voxels.back()));
        balls.back().radiusSq = kFine * kFine;
    }
    const SampledObject object = sampled(voxels);
    ASSERT_GT(excess(balls, voxels), 0);
    SearchEffort effort{kEffort, 0, 0, false};
    effort.sweeps = 1;
    const SearchedCover found =
        improveCover(ungrouped(balls), {}, object, VoxelGoal(object.level(0)), effort, nullptr);
    EXPECT_EQ(excess(ballsOf(found.balls), voxels), 0);
    EXPECT_EQ(found.balls.size(), balls.size());
}

/// Without trials every ball is placed anew, and that is all.
TEST(CoverSearch, TrialsGainAsMuchAsExpectedOnTop)
{
    Random random(5);
    double without = 0, with = 0;
    for (const int64_t count : {9, 12, 18}) {
        const Start start(shapes::noise(Coord(10, 8, 7), 0.5, random), count);
        const VoxelGoal goal(start.object.level(0));
        const auto change = [&](int trials) {
            return improveCover(ungrouped(start.balls), ungrouped(start.leaves), start.object, goal,
                {kEffort, trials, 0, false}, nullptr)
                .change;
        };
        without += change(0);
        with += change(20);
    }
    EXPECT_LT(without, 0);
    EXPECT_LE(with, expectedFigure("cover_search.gain_with_trials_to_without") * without);
}

/// Two balls that are not in each other's region share nothing.
TEST(CoverSearch, LeavesBallsInTheirGroups)
{
    Random random(3);
    const Start start(shapes::noise(Coord(9, 8, 8), 0.5, random), 5);
    std::vector<CoverBall> cover;
    for (const ExactSphere& ball : start.balls) cover.push_back({ball, int32_t(cover.size())});
    const SampleLevel& object = start.object.level(0);
    const auto cells = powerCells(start.balls, object, nullptr);
    const auto found = improveCover(
        cover, {}, start.object, VoxelGoal(object, cells), {kEffort, 30, 0, false}, nullptr);
    ASSERT_EQ(found.balls.size(), cover.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        EXPECT_EQ(found.balls[i].group, int32_t(i));
        for (const RegionLeaf part : cells[i]) {
            const LeafMask held = openvdb_spheretree::detail::voxelsOf(
                found.balls[i].ball, kFineShift, object.origin(part.leaf));
            for (int w = 0; w < 8; ++w) EXPECT_EQ(part.mask[w] & ~held[w], 0u);
        }
    }
}

} // namespace
