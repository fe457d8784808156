// SPDX-License-Identifier: Apache-2.0
/// @file TestMedialCover.cc
/// @brief A level whose spheres are the object's medial balls is known to be one, and none else is.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/measure/MedialCover.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>

#include "support/TreeSettings.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

namespace {

using namespace openvdb_spheretree;
using openvdb::BoolGrid;
using openvdb::Coord;
using spheretree_test::setType;

/// A solid with a corner, so that it has balls of many sizes.
BoolGrid::Ptr solid()
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().fill(openvdb::CoordBBox(Coord(-7, 2, 3), Coord(20, 19, 17)), true);
    object->tree().fill(openvdb::CoordBBox(Coord(-3, 2, 3), Coord(5, 40, 11)), true);
    object->tree().voxelizeActiveTiles();
    return object;
}

bool areMedial(const SphereTree& tree, const BoolGrid& object)
{
    const openvdb::MaskTree mask = detail::maskOf(object.tree());
    return detail::areMedialBalls(tree, tree.levels[0], mask, detail::countVoxels(mask), nullptr);
}

class MedialCover : public ::testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }

    static SphereTree treeOf(const BoolGrid& object, TreeType type)
    {
        SphereTreeSettings settings;
        setType(settings, type);
        return buildSphereTree(object, settings);
    }
};

TEST_F(MedialCover, IsThatOfLevelZero)
{
    const BoolGrid::Ptr object = solid();
    for (const TreeType type : {TreeType::Extended, TreeType::Reversible}) {
        SphereTree tree = treeOf(*object, type);
        EXPECT_TRUE(areMedial(tree, *object));
        computeLevelErrors(tree, *object);
        ASSERT_TRUE(tree.levels[0].error);
        EXPECT_EQ(tree.levels[0].error->covered, int64_t(object->activeVoxelCount()));
        EXPECT_EQ(tree.levels[0].error->excess, 0);
        EXPECT_EQ(tree.levels[0].error->missing, 0);
        EXPECT_EQ(tree.levels[0].error->hausdorff, 0);
    }
}

TEST_F(MedialCover, EverySphereCounts)
{
    const BoolGrid::Ptr object = solid();
    const SphereTree tree = treeOf(*object, TreeType::Extended);
    const SphereTreeLevel& level = tree.levels[0];
    ASSERT_GT(level.size(), 20);
    for (int32_t id = level.begin; id < level.end; id += 7) {
        SphereTree other = tree;
        other.spheres.coverRadiusSq[id] += 1;
        EXPECT_FALSE(areMedial(other, *object)) << id;
        other = tree;
        other.spheres.center[id][id % 3] += 0.5;
        EXPECT_FALSE(areMedial(other, *object)) << id;
    }
    SphereTree fewer = tree;
    fewer.levels[0].end -= 1;
    EXPECT_FALSE(areMedial(fewer, *object));
}

TEST_F(MedialCover, EveryVoxelOfTheObjectCounts)
{
    const BoolGrid::Ptr object = solid();
    SphereTree tree = treeOf(*object, TreeType::Extended);
    object->tree().setValueOff(Coord(0, 10, 10));
    EXPECT_FALSE(areMedial(tree, *object));
    computeLevelErrors(tree, *object);
    ASSERT_TRUE(tree.levels[0].error);
    EXPECT_EQ(tree.levels[0].error->excess, 1);
    EXPECT_EQ(tree.levels[0].error->missing, 0);

    object->tree().setValueOn(Coord(0, 10, 10));
    object->tree().setValueOn(Coord(40, 10, 10));
    computeLevelErrors(tree, *object);
    EXPECT_EQ(tree.levels[0].error->excess, 0);
    EXPECT_EQ(tree.levels[0].error->missing, 1);
}

TEST_F(MedialCover, OtherLevelsAndTreesAreDrawn)
{
    const BoolGrid::Ptr object = solid();
    const SphereTree tree = treeOf(*object, TreeType::Extended);
    const openvdb::MaskTree mask = detail::maskOf(object->tree());
    EXPECT_FALSE(detail::areMedialBalls(tree, tree.levels[1], mask, 1, nullptr));

    // One ball is drawn before any transform is done.
    SphereTree one = tree;
    one.levels[0].end = one.levels[0].begin + 1;
    EXPECT_FALSE(detail::areMedialBalls(one, one.levels[0], mask, 100000, nullptr));
}

} // namespace
