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

TEST(VoxelRegion, KeepsWholeLeavesAndPartsOfLeaves)
{
    LeafMask one{};
    one.setOn(17);
    const LeafMask others = LeafMask::full() - one;
    const std::vector<LeafMask> masks{LeafMask::full(), others, one, LeafMask::full()};
    const SampleLevel object({Coord(0), Coord(0, 0, 8), Coord(0, 8, 0), Coord(8, 0, 0)}, masks);
    VoxelRegion region(object);
    region.append(0, one);
    region.append(1, others); // all that the object has there
    region.append(2, LeafMask{});
    region.append(3, LeafMask::full());
    ASSERT_EQ(region.size(), 3u);
    EXPECT_EQ(region[0].mask, one);
    EXPECT_EQ(region[1].mask, others);
    EXPECT_EQ(region[2].mask, LeafMask::full());
    EXPECT_EQ(&region[1].mask, &object.mask(1)) << "no mask of its own";
    EXPECT_EQ(region.find(1), 1u);
    EXPECT_EQ(region.find(2), 2u);
    EXPECT_EQ(region.find(0, 1), 1u);
    EXPECT_EQ(region.find(4), 3u);
    EXPECT_EQ(maskIn(region, 1), others);
    EXPECT_TRUE(maskIn(region, 2).none());
}

} // namespace
