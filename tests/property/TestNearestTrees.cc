// SPDX-License-Identifier: Apache-2.0
/// @file TestNearestTrees.cc
/// @brief Trees with side=fit of random objects: what -check asks for, levels that only get better, the same for any
/// number of threads and for objects that were moved.

#include "support/BuiltTrees.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/measure/LevelErrors.h>

#include <tbb/global_control.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

SphereTreeSettings fitSettings()
{
    SphereTreeSettings settings = FitOptions();
    settings.budgeted().budget.branching = 2;
    return settings;
}

} // namespace

TEST(NearestTrees, HoldWhatTheyRecordAndNoLevelIsWorseThanACoarserOne)
{
    for (const RandomObject& object : someObjects(200, 40)) {
        SCOPED_TRACE(object.name);
        const auto grid = gridOf(object.voxels);
        SphereTree tree = buildSphereTree(*grid, fitSettings());
        computeLevelErrors(tree, *grid);
        EXPECT_EQ(tree.root().size(), 1);
        EXPECT_EQ(tree.levels[0].error->hammingPercent, 0) << "of all leaves";
        for (std::size_t k = 1; k < tree.levels.size(); ++k) {
            EXPECT_GE(
                tree.levels[k].error->hammingPercent, tree.levels[k - 1].error->hammingPercent);
            EXPECT_GT(tree.levels[k - 1].size(), tree.levels[k].size());
        }
        const auto faults = checkSphereTree(tree, *grid);
        EXPECT_TRUE(faults.empty()) << faults.front().sentence;
    }
}

TEST(NearestTrees, AreTheSameForAnyNumberOfThreads)
{
    using Control = tbb::global_control;
    for (const RandomObject& object : someObjects(240, 12)) {
        SCOPED_TRACE(object.name);
        const auto grid = gridOf(object.voxels);
        const auto built = [&](std::size_t threads) {
            const Control control(Control::max_allowed_parallelism, threads);
            return buildSphereTree(*grid, fitSettings());
        };
        EXPECT_TRUE(sameNodes(built(1), built(2)));
    }
}

/// By whole nodes, so that what is sorted by nodes is sorted in the same way; spheres that climb at once are others
/// otherwise.
TEST(NearestTrees, MoveWithTheirObject)
{
    const Coord by(-4096, 8192, 4096);
    for (const RandomObject& object : someObjects(260, 12)) {
        SCOPED_TRACE(object.name);
        Voxels moved;
        for (const Coord& v : object.voxels) moved.push_back(v + by);
        const SphereTree here = buildSphereTree(*gridOf(object.voxels), fitSettings());
        const SphereTree there = buildSphereTree(*gridOf(moved), fitSettings());
        ASSERT_EQ(here.size(), there.size());
        EXPECT_EQ(here.spheres.radiusWorld, there.spheres.radiusWorld);
        EXPECT_EQ(here.spheres.parent, there.spheres.parent);
        for (int32_t id = 0; id < here.size(); ++id) {
            EXPECT_EQ(here.spheres.center[std::size_t(id)] + by.asVec3d(),
                there.spheres.center[std::size_t(id)]);
        }
    }
}
