// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/search/CoverTrial.h>

#include "support/MergedLeaves.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

void expectTrials(const MergedLeaves& merged, int64_t count)
{
    const bool flat = merged.maker.flat;
    const auto start = merged.cut(count);
    const BallCover cover(ungrouped(start));
    const VoxelGoal goal(merged.object.level(0));
    const PartFit fit(cover, merged.object, goal, {merged.kEffort, 0, 0, flat});
    const int64_t before = excess(start, merged.voxels);
    int improving = 0;
    for (uint64_t number = 0; number < 150; ++number) {
        const CoverChange change = tryChange(cover, fit, number);
        if (change.ids.empty()) continue;
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
