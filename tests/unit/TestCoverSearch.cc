// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/CoverSearch.h>

#include "../support/FineBalls.h"

#include <openvdb_spheretree/tight/PowerCells.h>
#include <openvdb_spheretree/tight/SlackMerging.h>
#include <openvdb_spheretree/tight/TightLevels.h>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

const FitEffort kEffort{true, 12, 1, false, 40};

bool anyHolds(const std::vector<FineBall>& balls, const Voxels& voxels)
{
    return std::any_of(balls.begin(), balls.end(), [&](const FineBall& ball) {
        return std::all_of(
            voxels.begin(), voxels.end(), [&](const Coord& v) { return holds(ball, v); });
    });
}

/// Starts from a cut of merged leaves.
struct Start {
    Voxels voxels;
    SampledObject object;
    std::vector<FineBall> leaves, balls;

    Start(const Voxels& some, int64_t count) : voxels(some), object(sampled(voxels))
    {
        for (const auto& ball : CoreStages(*maskOf(voxels)).balls) leaves.push_back(fineBall(ball));
        const SampleLevel& level = object.level(0);
        SlackMerging model(
            object, ungrouped(leaves), regionsOf(leaves, level, nullptr), kEffort, false, nullptr);
        const auto forest = mergeToRoots(model, 6, nullptr);
        balls = ballsOfCut(forest, count);
    }
};

/// @param units  each to be held by one ball
void expectBetter(const Start& start, const CoverDebt& debt, const std::vector<Voxels>& units)
{
    const SearchedCover cover = improveCover(ungrouped(start.balls), ungrouped(start.leaves),
        start.object, debt, {kEffort, 15, 0, false}, nullptr);
    const auto balls = ballsOf(cover.balls);
    ASSERT_EQ(balls.size(), start.balls.size());
    for (const Voxels& unit : units) ASSERT_TRUE(anyHolds(balls, unit));
    ASSERT_LE(cover.change, 0);
    ASSERT_EQ(excess(balls, start.voxels) - excess(start.balls, start.voxels), cover.change);
}

TEST(CoverSearch, KeepsACoverOfVoxelsAndIsNeverWorse)
{
    Random random(1);
    for (const int64_t count : {1, 2, 5, 9}) {
        const Start start(shapes::noise(Coord(8, 7, 7), 0.5, random), count);
        std::vector<Voxels> alone;
        for (const Coord& v : start.voxels) alone.push_back({v});
        const VoxelDebt debt(start.object.level(0));
        ASSERT_NO_FATAL_FAILURE(expectBetter(start, debt, alone)) << count;
    }
}

TEST(CoverSearch, KeepsACoverOfUnitsAndIsNeverWorse)
{
    Random random(2);
    for (const int64_t count : {1, 3, 6}) {
        const Start start(shapes::noise(Coord(8, 7, 7), 0.5, random), count);
        const auto units = cellPoints(start.balls, start.object.level(0), nullptr);
        ASSERT_NO_FATAL_FAILURE(expectBetter(start, UnitDebt(units), units)) << count;
    }
}

} // namespace
