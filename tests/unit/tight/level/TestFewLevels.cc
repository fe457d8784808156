// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/FewLevels.h>

#include "support/MergedLeaves.h"

#include <openvdb_spheretree/tight/cluster/ClusterCover.h>
#include <openvdb_spheretree/tight/level/FinerLevel.h>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

const FitEffort kEffort{true, 12, 1, true, 40};

struct Merged : MergedLeaves {
    explicit Merged(const Voxels& voxels) : MergedLeaves(voxels, false, ::kEffort) {}
};

/// Checks that every voxel has a chain through the levels.
/// @return the voxels outside the object in each level.
std::vector<int64_t> expectChains(const Merged& merged, const std::vector<TightLevel>& levels)
{
    std::vector<int64_t> around;
    std::vector<Voxels> chains; // of each ball of the level above
    for (std::size_t k = levels.size(); k-- > 0;) {
        const TightLevel& level = levels[k];
        std::vector<Voxels> held;
        for (std::size_t i = 0; i < level.balls.size(); ++i) {
            EXPECT_FALSE(level.balls[i].empty());
            const Voxels& above =
                level.parent.empty() ? merged.voxels : chains.at(std::size_t(level.parent.at(i)));
            held.push_back(heldBy({level.balls[i]}, above));
        }
        EXPECT_EQ(together(held), merged.voxels) << "level " << k;
        chains = held;
        around.insert(around.begin(), excess(level.balls, merged.voxels));
    }
    return around;
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

TEST(FewLevels, KeepChainsAndAreNotWorseThanFewerBallsNorThanTheForest)
{
    Random random(1);
    int64_t merging = 0, found = 0;
    const std::vector<Voxels> objects{
        shapes::noise(Coord(9, 7, 8), 0.5, random), shapes::box(Coord(20, 6, 9)), ring(11)};
    for (const Voxels& voxels : objects) {
        const Merged merged(voxels);
        for (const Quality quality : {Quality::Fast, Quality::Normal}) {
            const std::vector<int64_t> counts{9, 5, 3, 1};
            const auto levels = fewLevels(counts, quality, merged.maker);
            ASSERT_EQ(levels.size(), counts.size());
            const auto around = expectChains(merged, levels);
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

TEST(FewLevels, OneLevelIsNotWorseThanClusters)
{
    const Merged merged(shapes::box(Coord(24, 5, 9)));
    const auto blocks = voxelBlocks(merged.object.level(0), 4096);
    for (const int64_t count : {2, 4, 7}) {
        const auto level = fewLevels({count}, Quality::Normal, merged.maker).front();
        for (uint64_t seed = 0; seed < 5; ++seed) {
            const auto clusters = clusterCover(clusterCenters(blocks, std::size_t(count), seed),
                merged.object, kEffort, false, nullptr);
            EXPECT_LE(excess(level.balls, merged.voxels), excess(clusters, merged.voxels));
        }
    }
}

/// A third of a ring is nearly as wide as the ring: clusters are worse than one ball.
TEST(FewLevels, OfARingAreNotWorseThanOneBall)
{
    for (const int radius : {12, 16, 21}) {
        const Merged merged(ring(radius));
        for (const int64_t count : {2, 3, 4}) {
            const auto around =
                expectChains(merged, fewLevels({count, 1}, Quality::Fast, merged.maker));
            EXPECT_LE(around[0], around[1]) << count << " balls, radius " << radius;
        }
    }
}

/// More balls could not be better.
TEST(FewLevels, WorkEndsWhereOneBallCostsNothing)
{
    const Merged merged(shapes::ball(60));
    const auto levels = fewLevels({40, 8, 1}, Quality::Normal, merged.maker);
    for (const TightLevel& level : levels) EXPECT_EQ(level.balls.size(), 1u);
    EXPECT_EQ(expectChains(merged, levels), (std::vector<int64_t>{0, 0, 0}));
}

} // namespace
