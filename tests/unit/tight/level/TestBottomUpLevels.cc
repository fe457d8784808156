// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/BottomUpLevels.h>

#include "support/MergedLeaves.h"

#include <set>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// Makes a level above, and the next ones above that.
/// @return the voxels around all of these.
int64_t expectLevels(const MergedLeaves& merged, const std::vector<ExactSphere>& finest,
    const std::vector<int64_t>& counts)
{
    const SampleLevel& object = merged.object.level(0);
    TightLevel finer;
    finer.balls = finest;
    auto regions = merged.regions(finer.balls);
    int64_t around = 0;
    for (const int64_t count : counts) {
        const auto before = voxelsOf(regions, object);
        const TightLevel level = coarserLevel(finer, regions, count, merged.maker);
        EXPECT_LE(level.balls.size(), std::size_t(count));
        EXPECT_EQ(finer.parent.size(), finer.balls.size());
        const std::set<int32_t> parents(finer.parent.begin(), finer.parent.end());
        EXPECT_EQ(parents.size(), level.balls.size()) << "each has a child";
        for (const ExactSphere& ball : level.balls) EXPECT_FALSE(ball.empty());
        const auto held = heldBelow(level.balls, finer.parent, before);
        EXPECT_EQ(together(held), merged.voxels);
        EXPECT_EQ(voxelsOf(regions, object), held);
        around += excess(thereOf(ungrouped(level.balls)), merged.voxels);
        finer = level;
    }
    return around;
}

TEST(BottomUpLevels, KeepChainsAndAreTighterThanMergedBalls)
{
    Random random(1);
    int64_t merging = 0, searched = 0;
    for (int turn = 0; turn < 2; ++turn) {
        const MergedLeaves merged(shapes::noise(Coord(7, 6, 5), 0.5, random));
        const std::vector<int64_t> counts{13, 5, 2};
        for (const int64_t count : counts) merging += excess(merged.cut(count), merged.voxels);
        searched += expectLevels(merged, merged.cut(13), counts);
    }
    EXPECT_LT(searched, merging);
}

TEST(BottomUpLevels, OfAllLeafBallsKeepTheseAndTheirChains)
{
    Random random(2);
    int64_t merging = 0, found = 0;
    for (const int64_t searchedUpTo : {0, 1000, 0, 1000, 0, 1000, 0, 1000}) {
        MergedLeaves merged(shapes::noise(Coord(9, 7, 6), 0.4, random));
        merged.maker.searchedUpTo = searchedUpTo;
        const TightLevel leaves = merged.levels({int64_t(merged.leaves.size())}).front();
        const std::vector<int64_t> counts{int64_t(merged.leaves.size()), 20, 5, 1};
        const auto levels = bottomUpLevels(leaves, counts, merged.maker);
        ASSERT_EQ(levels.size(), counts.size());
        EXPECT_EQ(levels.front().balls, merged.leaves);
        EXPECT_EQ(levels.front().digital.size(), merged.leaves.size());
        const auto around = expectChains(levels, merged.voxels);
        EXPECT_EQ(around.front(), 0);
        for (std::size_t k = 1; k < counts.size(); ++k) {
            EXPECT_LE(levels[k].balls.size(), std::size_t(counts[k]));
            merging += excess(merged.cut(counts[k]), merged.voxels);
            found += around[k];
        }
    }
    EXPECT_LT(found, merging);
}

/// Their voxels lie far apart, so the object has many leaf nodes for each ball.
TEST(BottomUpLevels, OfLargeBallsAreDecidedAtHalfTheResolutionAndKeepChains)
{
    Random random(3);
    for (const bool flat : {false, true}) {
        Voxels voxels = shapes::noise(flat ? Coord(25, 20, 1) : Coord(12, 10, 9), 0.4, random);
        for (Coord& v : voxels) v = Coord(8 * v[0], 8 * v[1] + v[0] % 3, flat ? 0 : 8 * v[2]);
        sortVoxels(voxels);
        MergedLeaves merged(voxels, flat);
        merged.maker.searchedUpTo = 1000;
        merged.maker.trialsPerBall = 2;
        const TightLevel finest = merged.levels({30}).front();
        const std::vector<int64_t> counts{int64_t(finest.balls.size()), 2, 1};
        ASSERT_GT(merged.object.level(0).leafCount(), 64 * std::size_t(counts[1]));
        const auto levels = bottomUpLevels(finest, counts, merged.maker);
        ASSERT_EQ(levels.size(), counts.size());
        expectChains(levels, merged.voxels);
    }
}

} // namespace
