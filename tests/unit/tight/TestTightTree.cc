// SPDX-License-Identifier: Apache-2.0
/// @file TestTightTree.cc
/// @brief What the steps of a tight tree are told: which kind of merging, and about which leaf balls.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/input/spheres/WorldSpheres.h>
#include <openvdb_spheretree/measure/LevelErrors.h>

#include "support/BuiltTrees.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// A given sphere that reaches out of the object costs what it holds there. So to merge it with one inside it is the
/// cheapest merge, though the two that have nothing outside are nearer.
TEST(TightTree, MergesOfGivenLeavesKnowWhatTheseHoldOutside)
{
    const auto object = gridOf({Coord(0, 0, 0), Coord(5, 0, 0), Coord(14, 0, 0)});
    WorldSpheres leaves;
    leaves.center = {{0, 0, 0}, {5, 0, 0}, {14, 0, 0}};
    leaves.radius = {8, 0.25, 0.25};
    const auto excessOf = [&](Cover cover, Quality quality) {
        TightOptions options;
        options.leaves = Leaves::Given;
        options.cover = cover;
        options.cuts = true;
        options.quality = quality;
        options.budget.spheres = {2};
        SphereTree tree = buildSphereTreeOver(leaves, *object, options);
        computeLevelErrors(tree, *object);
        return tree.levels.front().error->excess;
    };
    constexpr int64_t kInLarge = 2109; // voxels of the given sphere of radius 8
    EXPECT_EQ(excessOf(Cover::Balls, Quality::Fast), kInLarge - 2);
    for (const Quality quality : {Quality::Fast, Quality::Normal}) {
        EXPECT_LT(excessOf(Cover::Voxels, quality), kInLarge / 10);
    }
}

} // namespace
