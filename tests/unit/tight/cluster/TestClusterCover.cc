// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/cluster/ClusterCover.h>

#include "support/MergedLeaves.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

const FitEffort kEffort{true, 12, 1, true, 40};

TEST(ClusterCover, EachBallHoldsTheVoxelsNearestToItsCenter)
{
    Random random(1);
    for (const std::size_t count : {1, 3, 9}) {
        const MergedLeaves merged(shapes::noise(Coord(12, 9, 11), 0.4, random));
        const auto blocks = voxelBlocks(merged.object.level(0), 1000);
        const auto centers = clusterCenters(blocks, count, 1);
        const auto balls = clusterCover(centers, merged.object, kEffort, false, nullptr);
        ASSERT_EQ(balls.size(), count);
        for (const Coord& v : merged.voxels) {
            std::vector<int64_t> apartSq;
            for (const FineCenter& c : centers) {
                int64_t sum = 0;
                for (int a = 0; a < 3; ++a) sum += (16 * v[a] - c[a]) * (16 * v[a] - c[a]);
                apartSq.push_back(sum);
            }
            const int64_t least = *std::min_element(apartSq.begin(), apartSq.end());
            bool held = false; // by one that is nearest
            for (std::size_t i = 0; i < count; ++i) {
                held = held || (apartSq[i] == least && holds(balls[i], v));
            }
            EXPECT_TRUE(held);
        }
    }
}

TEST(ClusterCover, HasNoBallForACenterWithoutVoxels)
{
    const MergedLeaves merged({Coord(0, 0, 0), Coord(9, 0, 0)});
    const auto balls = clusterCover(
        {{0, 0, 0}, {1600, 0, 0}, {150, 0, 0}}, merged.object, kEffort, false, nullptr);
    ASSERT_EQ(balls.size(), 2u);
    EXPECT_TRUE(holds(balls[0], Coord(0, 0, 0)));
    EXPECT_TRUE(holds(balls[1], Coord(9, 0, 0)));
}

} // namespace
