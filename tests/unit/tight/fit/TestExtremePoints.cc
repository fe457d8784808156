// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/fit/ExtremePoints.h>

#include "support/FineBalls.h"

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

Voxels extremesOf(const Voxels& voxels)
{
    const LeafLayout layout(*maskOf(voxels));
    ExtremePoints extreme;
    extreme.add(Coord(0, 0, 0), LeafMask{1}); // to be forgotten
    extreme.clear();
    for (uint32_t leaf = 0; leaf < layout.leafCount(); ++leaf) {
        extreme.add(layout.origin(leaf), layout.mask(leaf));
    }
    return extreme.finish();
}

TEST(ExtremePoints, StandForAllVoxels)
{
    Random random(1);
    for (uint32_t seed = 3000; seed < 3110; ++seed) {
        const RandomObject object = randomObject(seed);
        ASSERT_TRUE(standFor(extremesOf(object.voxels), object.voxels, random)) << object.name;
        Voxels points = object.voxels;
        dropInnerPoints(points);
        ASSERT_TRUE(standFor(points, object.voxels, random)) << object.name;
    }
}

TEST(ExtremePoints, StandForVoxelsFarApart)
{
    Random random(2);
    for (int i = 0; i < 60; ++i) {
        Voxels voxels;
        const int reach = 1 << random.between(3, 29);
        for (int n = random.between(1, 90); n > 0; --n)
            voxels.push_back(random.coord(-reach, reach));
        for (Coord& v : voxels) v[i % 3] = i % 2 ? random.between(-1, 1) : v[i % 3]; // few slices
        sortVoxels(voxels);
        Voxels points = voxels;
        dropInnerPoints(points);
        ASSERT_TRUE(standFor(points, voxels, random));
        ASSERT_TRUE(standFor(extremesOf(voxels), voxels, random));
    }
}

TEST(ExtremePoints, StandForTwoSetsOneAfterTheOther)
{
    Random random(3);
    for (uint32_t seed = 3000; seed < 3050; ++seed) {
        const Voxels all = randomObject(seed).voxels;
        Voxels points, second;
        for (const Coord& voxel : all) (random.between(0, 1) ? points : second).push_back(voxel);
        points.insert(points.end(), second.begin(), second.end());
        dropInnerPoints(points);
        ASSERT_TRUE(standFor(points, all, random)) << seed;
        EXPECT_TRUE(std::is_sorted(points.begin(), points.end()));
    }
}

TEST(ExtremePoints, AreFew)
{
    EXPECT_EQ(extremesOf(translated(shapes::box(Coord(20, 30, 25)), Coord(-9, 4, 3))).size(), 8u);
    EXPECT_EQ(extremesOf(shapes::box(Coord(1, 1, 25))).size(), 2u);
    EXPECT_EQ(extremesOf(shapes::box(Coord(9, 1, 25))).size(), 4u);
    const Voxels ball = shapes::ball(200);
    EXPECT_LT(extremesOf(ball).size(), ball.size() / 10);
    EXPECT_TRUE(extremesOf({}).empty());
}

} // namespace
