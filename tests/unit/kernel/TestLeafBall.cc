// SPDX-License-Identifier: Apache-2.0
/// @file TestLeafBall.cc
/// @brief Both kernels of Euclidean balls against one voxel after the other, also where numbers are
/// the largest that they take.

#include "support/RandomObjects.h"

#include <openvdb_spheretree/kernel/LeafBall.h>
#include <openvdb_spheretree/voxel/LeafMask.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::detail;
using namespace spheretree_test;

namespace {

/// In 1 / 2^shift of a voxel, from the leaf's corner.
struct Ball {
    int64_t center[3], radiusSq;
    int shift;

    int64_t distSq(uint32_t n) const
    {
        int64_t sum = 0;
        const int64_t q[3] = {n >> 6, n >> 3 & 7, n & 7};
        for (int a = 0; a < 3; ++a) {
            const int64_t d = (q[a] << shift) - center[a];
            sum += d * d;
        }
        return sum;
    }
    LeafMask voxels() const
    {
        LeafMask mask{};
        for (uint32_t n = 0; n < kLeafVoxels; ++n) {
            if (distSq(n) <= radiusSq) mask.setOn(n);
        }
        return mask;
    }
};

/// Through a random voxel of the leaf, from as far away as a center may be.
Ball randomBall(Random& random, int shift, int farthest)
{
    Ball ball{{}, 0, shift};
    const int last = 7 << shift;
    for (int64_t& c : ball.center) c = random.between(last - farthest, farthest);
    ball.radiusSq = ball.distSq(uint32_t(random.between(0, int(kLeafVoxels) - 1)));
    ball.radiusSq =
        std::min(ball.radiusSq + random.between(-1, 1), kLeafBallReach * kLeafBallReach);
    return ball;
}

constexpr auto kKernels = {orBallIntoLeaf, orBallIntoLeafPortable};

} // namespace

TEST(LeafBall, BothKernelsDrawTheVoxelsOfTheBall)
{
    Random random(12);
    int cut = 0; // leaves that a ball cuts
    for (const int farthest : {128, 300, 1000, int(kLeafBallReach)}) {
        for (int i = 0; i < 400; ++i) {
            // A leaf of the finest units is wider than the nearer ones of these.
            const int shift = farthest == kLeafBallReach && i % 5 == 4 ? 10 : 1 + i % 4;
            const Ball ball = randomBall(random, shift, farthest);
            const LeafMask expected = ball.voxels();
            for (const auto draw : kKernels) {
                LeafMask mask{};
                draw(ball.center, ball.radiusSq, ball.shift, mask.data());
                ASSERT_EQ(mask, expected) << farthest << ' ' << i;
            }
            cut += !expected.none() && !expected.all();
        }
    }
    EXPECT_GT(cut, 1000);
}

TEST(LeafBall, BothKernelsLeaveOtherVoxelsAsTheyAre)
{
    const Ball ball{{0, 0, 0}, 4, 1}; // the corner and the three voxels beside it
    for (const auto draw : kKernels) {
        LeafMask mask{};
        mask.setOn(500);
        draw(ball.center, ball.radiusSq, ball.shift, mask.data());
        EXPECT_TRUE(mask.isOn(500));
        EXPECT_EQ(mask.count(), 5);
    }
}
