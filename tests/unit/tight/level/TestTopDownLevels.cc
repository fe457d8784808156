// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/TopDownLevels.h>

#include "support/MergedLeaves.h"

#include <openvdb_spheretree/tight/cluster/ClusterCover.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

const FitEffort kEffort{true, 12, 1, true, 40};

struct Merged : MergedLeaves {
    explicit Merged(const Voxels& voxels) : MergedLeaves(voxels, false, ::kEffort) {}
};

std::vector<TightLevel> levelsOf(const Merged& merged, const std::vector<int64_t>& counts,
    Quality quality, bool withClusters = true)
{
    FreeCovers free(merged.leaves, true, merged.maker);
    return topDownLevels(counts, free, withClusters, quality, merged.maker);
}

/// @return what levels of `fast` hold around the object that know others.
std::vector<int64_t> aroundBelow(
    const Merged& merged, const std::vector<int64_t>& counts, const std::vector<TightLevel>& given)
{
    FreeCovers free(merged.leaves, true, merged.maker);
    return expectChains(
        topDownLevels(counts, free, true, Quality::Fast, merged.maker, given), merged.voxels);
}

int64_t sumOf(const std::vector<int64_t>& around)
{
    return std::accumulate(around.begin(), around.end(), int64_t(0));
}

Voxels ring(int count)
{
    Voxels voxels;
    for (int x = -count; x <= count; ++x) {
        for (int y = -count; y <= count; ++y) {
            const int sq = x * x + y * y;
            if (sq > count * count || sq < (count - 3) * (count - 3)) continue;
            for (int z = 0; z < 3; ++z) voxels.push_back(Coord(x, y, z));
        }
    }
    return voxels;
}

TEST(TopDownLevels, KeepChainsAndAreNotWorseThanFewerBallsNorThanTheForest)
{
    Random random(1);
    int64_t merging = 0, found = 0;
    const std::vector<Voxels> objects{
        shapes::noise(Coord(9, 7, 8), 0.5, random), shapes::box(Coord(20, 6, 9)), ring(11)};
    for (const Voxels& voxels : objects) {
        const Merged merged(voxels);
        for (const Quality quality : {Quality::Fast, Quality::Normal}) {
            const std::vector<int64_t> counts{9, 5, 3, 1};
            const auto levels = levelsOf(merged, counts, quality);
            ASSERT_EQ(levels.size(), counts.size());
            const auto around = expectChains(levels, merged.voxels);
            for (std::size_t k = 0; k < counts.size(); ++k) {
                EXPECT_LE(levels[k].balls.size(), std::size_t(counts[k]));
                EXPECT_LE(around[k], k + 1 < around.size() ? around[k + 1] : around[k]);
                if (quality == Quality::Fast) continue;
                merging += excess(merged.cut(counts[k]), merged.voxels);
                found += around[k];
            }
        }
    }
    EXPECT_LT(found, merging);
}

TEST(TopDownLevels, OneLevelIsNotWorseThanClusters)
{
    const Merged merged(shapes::box(Coord(24, 5, 9)));
    const auto blocks = voxelBlocks(merged.object.level(0), 4096);
    for (const int64_t count : {2, 4, 7}) {
        const auto level = levelsOf(merged, {count}, Quality::Normal).front();
        for (uint64_t seed = 0; seed < 5; ++seed) {
            const auto clusters = clusterCover(clusterCenters(blocks, std::size_t(count), seed),
                merged.object, kEffort, false, nullptr);
            EXPECT_LE(excess(level.balls, merged.voxels), excess(clusters, merged.voxels));
        }
    }
}

/// A third of a ring is nearly as wide as the ring: clusters are worse than one ball.
TEST(TopDownLevels, OfARingAreNotWorseThanOneBall)
{
    for (const int radius : {12, 16, 21}) {
        const Merged merged(ring(radius));
        for (const int64_t count : {2, 3, 4}) {
            const auto around =
                expectChains(levelsOf(merged, {count, 1}, Quality::Fast), merged.voxels);
            EXPECT_LE(around[0], around[1]) << count << " balls, radius " << radius;
        }
    }
}

/// Of given leaf balls nobody asked before whether their levels have room.
TEST(TopDownLevels, RegionsThatNeedMoreThanThereMayBeAreRefused)
{
    Merged merged(shapes::box(Coord(20, 6, 9)));
    const std::vector<int64_t> counts{9, 5, 3, 1};
    int64_t most = 0;
    for (const TightLevel& level : levelsOf(merged, counts, Quality::Fast)) {
        most = std::max(most, int64_t(std::ceil(merged.maker.regionMemory(level.balls).bytes)));
    }
    merged.maker.memory = most;
    EXPECT_NO_THROW(levelsOf(merged, counts, Quality::Fast));
    merged.maker.memory = most - 1;
    EXPECT_THROW(levelsOf(merged, counts, Quality::Fast), openvdb::ValueError);
}

/// More balls could not be better.
TEST(TopDownLevels, WorkEndsWhereOneBallCostsNothing)
{
    const Merged merged(shapes::ball(60));
    const auto levels = levelsOf(merged, {40, 8, 1}, Quality::Normal);
    for (const TightLevel& level : levels) EXPECT_EQ(level.balls.size(), 1u);
    EXPECT_EQ(expectChains(levels, merged.voxels), (std::vector<int64_t>{0, 0, 0}));
}

TEST(TopDownLevels, OfGivenOnesNoneCostsMore)
{
    Random random(8);
    for (int turn = 0; turn < 4; ++turn) {
        const Merged merged(shapes::noise(Coord(10, 9, 8), 0.4, random));
        const std::vector<int64_t> counts{12, 6, 3};
        const auto given = levelsOf(merged, counts, Quality::Best);
        const auto around = expectChains(given, merged.voxels),
                   quick = expectChains(levelsOf(merged, counts, Quality::Fast), merged.voxels);
        const auto found = aroundBelow(merged, counts, given);
        for (std::size_t k = 0; k < counts.size(); ++k) EXPECT_LE(found[k], around[k]);
        EXPECT_LT(sumOf(found), sumOf(quick));
        const ExactSphere all = merged.cut(1).front();
        EXPECT_EQ(
            aroundBelow(merged, counts, {{{all}, {0}, {}}, {{all}, {0}, {}}, {{all}, {}, {}}}),
            quick); // it costs more than any level
    }
}

/// Of given spheres, levels are made by merging these alone.
TEST(TopDownLevels, KeepChainsWithoutClusters)
{
    Random random(3);
    for (int turn = 0; turn < 5; ++turn) {
        const Merged merged(shapes::noise(Coord(11, 8, 9), 0.3, random));
        const auto levels = levelsOf(merged, {30, 11, 4, 2, 1}, Quality::Normal, false);
        const auto around = expectChains(levels, merged.voxels);
        EXPECT_TRUE(std::is_sorted(around.begin(), around.end()));
    }
}

} // namespace
