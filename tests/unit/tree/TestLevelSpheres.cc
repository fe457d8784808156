// SPDX-License-Identifier: Apache-2.0
/// @file TestLevelSpheres.cc
/// @brief The spheres of a level of a tree in integers, and the voxels that they cover.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <vector>

namespace {

using namespace openvdb_spheretree;

TEST(LevelSpheres, SpheresOfALevelAreItsRangeInTheTreesUnits)
{
    SphereTree tree;
    tree.spheres.center = {{0, 0, 0}, {-1.5, 2, 1048576.5}, {3, -4, 5}};
    tree.spheres.coverRadiusSq = {100, 7, 9};
    SphereTreeLevel level;
    level.begin = 1;
    level.end = 3;
    const std::vector<ExactSphere> spheres = levelSpheres(tree, level);
    ASSERT_EQ(spheres.size(), 2u);
    EXPECT_EQ(spheres[0].center[0], -3);
    EXPECT_EQ(spheres[0].center[1], 4);
    EXPECT_EQ(spheres[0].center[2], 2097153);
    EXPECT_EQ(spheres[0].radiusSq, 7);
    EXPECT_EQ(spheres[1].center[1], -8);
    EXPECT_EQ(spheres[1].radiusSq, 9);
    tree.subdivision = 16;
    tree.spheres.center[1] = {-1.4375, 2147483647.9375, -2147483648.0};
    const ExactSphere fine = levelSpheres(tree, level)[0];
    EXPECT_EQ(fine.center[0], -23);
    EXPECT_EQ(fine.center[1], (int64_t(1) << 35) - 1);
    EXPECT_EQ(fine.center[2], -(int64_t(1) << 35));
    EXPECT_EQ(metricOf(tree).subdivision, 16);
}

TEST(LevelUnion, OfAFlatTreeStaysInItsPlane)
{
    auto object = openvdb::BoolGrid::create();
    for (int x = -20; x <= 20; ++x) {
        for (int y = -20; y <= 20; ++y) {
            if (x * x + y * y < 400) object->tree().setValueOn(openvdb::Coord(x, y, 7));
        }
    }
    SphereTreeSettings settings;
    settings.dim = 2;
    const auto tree = buildSphereTree(*object, settings);
    const auto covered = levelUnion(tree, tree.levels.front());
    EXPECT_EQ(covered->activeVoxelCount(), object->activeVoxelCount());
    covered->topologyDifference(object->tree());
    EXPECT_EQ(covered->activeVoxelCount(), 0u);
}

TEST(LevelUnion, OfSpheresTooLargeToDrawIsAnError)
{
    auto object = openvdb::BoolGrid::create();
    object->tree().setValueOn(openvdb::Coord(0, 0, 0));
    object->tree().setValueOn(openvdb::Coord(60000, 0, 0));
    const auto tree = buildSphereTree(*object);
    EXPECT_THROW(levelUnion(tree, tree.root()), openvdb::ValueError);
    EXPECT_EQ(levelUnion(tree, tree.levels.front())->activeVoxelCount(), 2u);
}

} // namespace
