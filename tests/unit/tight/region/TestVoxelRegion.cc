// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include "support/FineBalls.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

Voxels regionVoxels(const VoxelRegion& region, const SampleLevel& object)
{
    Voxels voxels;
    for (std::size_t i = 0; i < region.size(); ++i) {
        EXPECT_FALSE(region[i].mask.none());
        EXPECT_TRUE(i == 0 || region[i - 1].leaf < region[i].leaf);
        for (const Coord& v : voxelsOf(region[i].mask, object.origin(region[i].leaf))) {
            voxels.push_back(v);
        }
    }
    sortVoxels(voxels);
    return voxels;
}

template <typename Holds>
Voxels those(const Voxels& voxels, const Holds& wanted)
{
    Voxels some;
    std::copy_if(voxels.begin(), voxels.end(), std::back_inserter(some), wanted);
    return some;
}

TEST(VoxelRegion, OfABallAreTheObjectsVoxelsInIt)
{
    Random random(1);
    for (int turn = 0; turn < 200; ++turn) {
        const Voxels voxels = shapes::noise(Coord(20, 19, 18), turn % 2 ? 0.02 : 0.6, random);
        const SampledObject object = sampled(voxels);
        const SampleLevel& level = object.level(0);
        const ExactSphere a = randomBall(random, -5, 25, 12), b = randomBall(random, -5, 25, 12);
        const ExactSphere clip = randomBall(random, 0, 20, 20);
        const VoxelRegion inA = regionOf(a, level), inB = regionOf(b, level);
        ASSERT_EQ(
            regionVoxels(inA, level), those(voxels, [&](const Coord& v) { return holds(a, v); }));
        ASSERT_EQ(regionVoxels(clipped(inA, clip, level), level),
            those(voxels, [&](const Coord& v) { return holds(a, v) && holds(clip, v); }));
        ASSERT_EQ(regionVoxels(unionOf(inA, inB), level),
            those(voxels, [&](const Coord& v) { return holds(a, v) || holds(b, v); }));
        ASSERT_EQ(regionVoxels(intersectionOf(inA, inB), level),
            those(voxels, [&](const Coord& v) { return holds(a, v) && holds(b, v); }));
        ASSERT_EQ(regionVoxels(differenceOf(inA, inB), level),
            those(voxels, [&](const Coord& v) { return holds(a, v) && !holds(b, v); }));
        for (uint32_t leaf = 0; leaf < level.leafCount(); ++leaf) {
            ASSERT_EQ(voxelsOf(maskIn(inA, leaf), level.origin(leaf)),
                those(voxels,
                    [&](const Coord& v) { return holds(a, v) && (v & ~7) == level.origin(leaf); }));
        }
        ASSERT_EQ(regionVoxels(clipped(unionOf(inA, inB), clip, level), level),
            those(voxels,
                [&](const Coord& v) { return (holds(a, v) || holds(b, v)) && holds(clip, v); }));
    }
    EXPECT_TRUE(regionOf(ExactSphere(), sampled({Coord(0, 0, 0)}).level(0)).empty());
}

} // namespace
