// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/FewLevels.h>

#include "support/MergedLeaves.h"

#include <openvdb_spheretree/tight/level/TopDownLevels.h>

#include <algorithm>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

const std::vector<int64_t> kCounts{14, 9, 5, 3, 2};

std::vector<double> costsOf(const std::vector<TightLevel>& levels, const LevelMaker& maker)
{
    std::vector<double> costs;
    for (const TightLevel& level : levels) costs.push_back(maker.costOf(level.balls));
    return costs;
}

/// Levels of every quality, each with its own effort; the last are those of `normal` that know nothing of `fast`.
struct Qualities {
    explicit Qualities(const MergedLeaves& merged)
        : fast(merged.maker.ofQuality(Quality::Fast, merged.leaves.size())),
          normal(merged.maker.ofQuality(Quality::Normal, merged.leaves.size()))
    {
        FreeCovers ofFast(merged.leaves, true, fast), ofNormal(merged.leaves, true, normal),
            ofAlone(merged.leaves, true, normal);
        lower = fewLevels(kCounts, ofFast, true, Quality::Fast, fast);
        higher = fewLevels(kCounts, ofNormal, true, Quality::Normal, normal);
        alone = topDownLevels(kCounts, ofAlone, true, Quality::Normal, normal);
    }
    LevelMaker fast, normal;
    std::vector<TightLevel> lower, higher, alone;
};

TEST(FewLevels, NoneCostsMoreThanWithLessQuality)
{
    Random random(5);
    int worseAlone = 0, better = 0;
    for (int turn = 0; turn < 8; ++turn) {
        const MergedLeaves merged(turn % 2 ? shapes::noise(Coord(12, 9, 8), 0.3, random)
                                           : shapes::pricked(shapes::ball(90, 20), 0.02, random));
        const Qualities made(merged);
        const auto around = expectChains(made.higher, merged.voxels);
        EXPECT_TRUE(std::is_sorted(around.begin(), around.end()));
        const auto lower = costsOf(made.lower, made.normal),
                   higher = costsOf(made.higher, made.normal),
                   alone = costsOf(made.alone, made.normal);
        for (std::size_t k = 0; k < kCounts.size(); ++k) {
            EXPECT_LE(made.higher[k].balls.size(), std::size_t(kCounts[k]));
            EXPECT_LE(higher[k], lower[k]) << kCounts[k] << " balls, object " << turn;
            worseAlone += alone[k] > lower[k];
            better += higher[k] < lower[k];
        }
    }
    EXPECT_GT(worseAlone, 0); // else nothing was tested
    EXPECT_GT(better, 10);
}

} // namespace
