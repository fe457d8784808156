// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/search/CoverRelocation.h>

#include "support/MergedLeaves.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// Wide, so that many balls go at a time.
TEST(CoverRelocation, KeepsACoverAndSaysWhatItGains)
{
    Random random(1);
    for (int turn = 0; turn < 2; ++turn) {
        const MergedLeaves merged(shapes::noise(Coord(40, 6, 5), 0.5, random));
        const auto start = merged.cut(60);
        BallCover cover(ungrouped(start));
        const VoxelGoal goal(merged.object.level(0));
        const PartFit fit(cover, merged.object, goal, {merged.kEffort, 0, 0, false});
        const auto finer = ungrouped(merged.leaves);
        CoverRelocation relocation(cover, fit, finer, nullptr);
        const int64_t before = excess(start, merged.voxels);
        int64_t last = 0;
        for (int i = 0; i < 3; ++i) {
            relocation.relocate();
            const auto balls = thereOf(cover.balls());
            ASSERT_EQ(heldBy(balls, merged.voxels), merged.voxels);
            const int64_t change = excess(balls, merged.voxels) - before;
            ASSERT_EQ(relocation.change(), double(change));
            ASSERT_LT(change, last);
            last = change;
        }
    }
}

/// A ball counts where its group's parent holds the voxel, too: one of the other group cannot stand in for it.
TEST(CoverRelocation, EveryVoxelStaysWithABallOfAGroupThatHoldsIt)
{
    Random random(3);
    for (int turn = 0; turn < 3; ++turn) {
        const MergedLeaves merged(shapes::noise(Coord(24, 8, 5), 0.5, random));
        // Two parents beside each other, which overlap in the middle.
        const std::vector<ExactSphere> parents = {
            {{6 * kFine, 4 * kFine, 2 * kFine}, 64 * kFine * kFine},
            {{18 * kFine, 4 * kFine, 2 * kFine}, 200 * kFine * kFine}};
        const Voxels voxels = heldBy(parents, merged.voxels);
        const auto regions = merged.regions(parents);
        std::vector<CoverBall> balls;
        for (const ExactSphere& ball : merged.cut(40)) {
            for (int32_t group : {0, 1}) {
                if (!heldBy({parents[std::size_t(group)]}, heldBy({ball}, voxels)).empty())
                    balls.push_back({ball, group});
            }
        }
        BallCover cover(balls);
        const VoxelGoal goal(merged.object.level(0), regions);
        const PartFit fit(cover, merged.object, goal, {merged.kEffort, 0, 0, false});
        std::vector<CoverBall> finer;
        for (const int32_t group : {0, 1}) {
            for (const ExactSphere& ball : merged.leaves) finer.push_back({ball, group});
        }
        CoverRelocation relocation(cover, fit, finer, nullptr);
        for (int i = 0; i < 3; ++i) {
            relocation.relocate();
            std::vector<Voxels> held(2);
            for (const CoverBall& ball : cover.balls()) {
                if (ball.empty()) continue;
                const Voxels some =
                    heldBy({parents[std::size_t(ball.group)]}, heldBy({ball.ball}, voxels));
                auto& all = held[std::size_t(ball.group)];
                all.insert(all.end(), some.begin(), some.end());
            }
            ASSERT_EQ(together(held), voxels) << turn << " " << i;
        }
        EXPECT_LT(relocation.change(), 0);
    }
}

} // namespace
