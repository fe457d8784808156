// SPDX-License-Identifier: Apache-2.0
/// @file TestKeepLevel.cc
/// @brief One level of a tree as a tree of its own: its nodes, what it records, what is refused.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include "support/BuiltTrees.h"
#include "support/Messages.h"

#include <openvdb/openvdb.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

openvdb::BoolGrid::Ptr someGrid(uint32_t seed = 8) { return gridOf(randomObject(seed).voxels); }

TEST(KeepLevel, KeepsTheNodesOfOneLevelAsRoots)
{
    SphereTreeSettings settings = extendedTree();
    settings.pyramid().dag = true;
    const SphereTree tree = buildSphereTree(*someGrid(), settings);
    ASSERT_GT(tree.levels.size(), 2u);
    for (const SphereTreeLevel& level : tree.levels) {
        const SphereTree kept = keepLevel(tree, level.level);
        ASSERT_EQ(kept.size(), level.size());
        for (int32_t i = 0; i < kept.size(); ++i) {
            EXPECT_EQ(kept.spheres.center[i], tree.spheres.center[level.begin + i]);
            EXPECT_EQ(kept.spheres.radius[i], tree.spheres.radius[level.begin + i]);
            EXPECT_EQ(kept.spheres.coverRadiusSq[i], tree.spheres.coverRadiusSq[level.begin + i]);
            EXPECT_EQ(kept.spheres.radiusWorld[i], tree.spheres.radiusWorld[level.begin + i]);
            EXPECT_EQ(kept.ijk[i], tree.ijk[level.begin + i]);
            EXPECT_EQ(kept.radiusSq[i], tree.radiusSq[level.begin + i]);
            EXPECT_EQ(kept.spheres.parent[i], -1);
            EXPECT_EQ(kept.levelOf(i), level.level);
        }
        ASSERT_EQ(kept.levels.size(), 1u);
        EXPECT_EQ(kept.levels[0].pyramidVoxels, level.pyramidVoxels);
        EXPECT_TRUE(kept.dag.empty());
    }
}

TEST(KeepLevel, KeepsWhatTheTreeRecords)
{
    SphereTreeSettings settings = extendedTree();
    settings.pyramid().factor = 3;
    settings.name = "kept";
    const auto grid = someGrid();
    grid->setName("object");
    SphereTree tree = buildSphereTree(*grid, settings);
    tree.levels[1].error = LevelError{5, 4, 3, 2, 1};
    const SphereTree kept = keepLevel(tree, 1);
    EXPECT_EQ(kept.settings.pyramid().factor, 3);
    EXPECT_EQ(kept.settings.name, "kept");
    EXPECT_EQ(kept.object.name, "object");
    EXPECT_EQ(kept.object.bbox, tree.object.bbox);
    EXPECT_EQ(kept.object.voxels, tree.object.voxels);
    EXPECT_EQ(kept.origin, tree.origin);
    EXPECT_EQ(*kept.transform, *tree.transform);
    EXPECT_NE(kept.transform, tree.transform);
    ASSERT_TRUE(kept.levels[0].error.has_value());
    EXPECT_EQ(kept.levels[0].error->covered, 5);
    ASSERT_TRUE(kept.levels[0].topology.has_value());
    EXPECT_TRUE(kept.levels[0].topology == tree.levels[1].topology);
}

TEST(KeepLevel, RejectsALevelThatIsNotThere)
{
    const SphereTree tree = buildSphereTree(*someGrid());
    const int top = tree.root().level;
    for (int level : {-1, top + 1}) {
        const auto message = messageOf<openvdb::ValueError>([&] { keepLevel(tree, level); });
        EXPECT_TRUE(mentions(message, "no level " + std::to_string(level)));
        EXPECT_TRUE(mentions(message, "0 to " + std::to_string(top)));
    }
    EXPECT_THROW(keepLevel(keepLevel(tree, 1), 0), openvdb::ValueError);
}

} // namespace
