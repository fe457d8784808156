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

} // namespace
