// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/search/CoverTrial.h>

#include "support/MergedLeaves.h"

#include <openvdb_spheretree/tight/search/RandomMoves.h>

#include <cmath>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// @return by how much the cost may rise where a trial disturbs ball @a id of a cover: half of what it costs beside the
/// others, and half a layer of voxels around it.
double mostRise(const std::vector<ExactSphere>& cover, std::size_t id, const MergedLeaves& merged)
{
    std::vector<ExactSphere> others(cover);
    others.erase(others.begin() + std::ptrdiff_t(id));
    const auto cost = double(excess(cover, merged.voxels) - excess(others, merged.voxels));
    const double radius = cover[id].radius() / double(kFine);
    const double around = merged.maker.flat ? 2 * M_PI * radius : 4 * M_PI * radius * radius;
    return (cost + around) / 2;
}

void expectTrials(const MergedLeaves& merged, int64_t count)
{
    const bool flat = merged.maker.flat;
    const auto start = merged.cut(count);
    const BallCover cover(ungrouped(start));
    const VoxelGoal goal(merged.object.level(0));
    const PartFit fit(cover, merged.object, goal, {merged.kEffort, 0, 0, flat});
    const int64_t before = excess(start, merged.voxels);
    int improving = 0, givenUp = 0;
    for (uint64_t number = 0; number < 150; ++number) {
        const CoverChange change = tryChange(cover, fit, number);
        if (change.ids.empty()) {
            ++givenUp;
            continue;
        }
        const std::size_t disturbed = Dice(number).below(start.size());
        ASSERT_LE(change.change, mostRise(start, disturbed, merged) + 1e-9);
        BallCover changed(cover);
        apply(change, changed);
        for (const CoverBall& ball : change.balls) {
            ASSERT_TRUE(ball.empty() || change.box.contains(FineBox(ball.ball)));
            ASSERT_TRUE(ball.empty() || !flat || ball.ball.center[2] == 0);
        }
        const auto balls = thereOf(changed.balls());
        ASSERT_EQ(heldBy(balls, merged.voxels), merged.voxels) << number;
        ASSERT_EQ(change.change, double(excess(balls, merged.voxels) - before)) << number;
        improving += change.improves();
    }
    EXPECT_GT(improving, 0);
    EXPECT_GT(givenUp, 0);
}

TEST(CoverTrial, KeepsACoverAndSaysWhatItGains)
{
    Random random(1);
    expectTrials(MergedLeaves(shapes::noise(Coord(20, 6, 5), 0.5, random)), 15);
}

TEST(CoverTrial, StaysInThePlaneOfAFlatObject)
{
    Random random(2);
    expectTrials(MergedLeaves(shapes::noise(Coord(20, 15, 1), 0.5, random), true), 15);
}

} // namespace
