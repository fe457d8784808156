// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/FinerLevel.h>

#include "support/MergedLeaves.h"

#include <openvdb_spheretree/tight/region/PowerCells.h>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// @return what each ball holds of its parent's region.
std::vector<Voxels> heldInRegions(const TightLevel& level, const std::vector<Voxels>& regions)
{
    std::vector<Voxels> held;
    for (std::size_t i = 0; i < level.balls.size(); ++i) {
        held.emplace_back();
        for (const Coord& v : regions.at(level.parent.at(i))) {
            if (holds(level.balls[i], v)) held.back().push_back(v);
        }
    }
    return held;
}

/// Makes a level below, and the next ones below that.
/// @return the voxels around all of these.
int64_t expectLevels(const MergedLeaves& merged, const std::vector<ExactSphere>& coarsest,
    const std::vector<int64_t>& counts)
{
    const SampleLevel& object = merged.object.level(0);
    const BallCells leaves{merged.leaves, powerCells(merged.leaves, object, nullptr)};
    TightLevel coarser;
    coarser.balls = coarsest;
    auto regions = chainRegions(coarser, {}, merged.maker);
    EXPECT_EQ(voxelsOf(regions, object), voxelsOf(merged.regions(coarser.balls), object));
    int64_t around = 0;
    for (const int64_t count : counts) {
        const TightLevel level = finerLevel(coarser, regions, leaves, count, merged.maker);
        EXPECT_LE(level.balls.size(), std::size_t(count));
        for (const ExactSphere& ball : level.balls) EXPECT_FALSE(ball.empty());
        const auto held = heldInRegions(level, voxelsOf(regions, object));
        EXPECT_EQ(together(held), merged.voxels);
        regions = chainRegions(level, regions, merged.maker);
        EXPECT_EQ(voxelsOf(regions, object), held);
        around += excess(thereOf(ungrouped(level.balls)), merged.voxels);
        coarser = level;
    }
    return around;
}

TEST(FinerLevel, KeepsChainsAndIsTighterThanMergedBalls)
{
    Random random(1);
    int64_t merging = 0, searched = 0;
    for (const double rate : {0.5, 0.9}) {
        const MergedLeaves merged(shapes::noise(Coord(7, 6, 5), rate, random));
        const std::vector<int64_t> counts{7, 12};
        for (const int64_t count : counts) merging += excess(merged.cut(count), merged.voxels);
        searched += expectLevels(merged, merged.cut(3), counts);
    }
    EXPECT_LT(searched, merging);
}

TEST(FinerLevel, HasALeafInEachGroupThatHasAPartOfItsCell)
{
    MergedLeaves merged(shapes::ball(30));
    merged.leaves = {{{0, 0, 0}, 16 * 16 * 29}};
    const std::vector<ExactSphere> halves{{{-64, 0, 0}, 109 * 109}, {{64, 0, 0}, 109 * 109}};
    expectLevels(merged, halves, {2, 2});
}

} // namespace
