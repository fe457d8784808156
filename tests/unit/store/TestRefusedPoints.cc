// SPDX-License-Identifier: Apache-2.0
/// @file TestRefusedPoints.cc
/// @brief A tree that could not be read back is not written.

#include <openvdb_spheretree/store/SphereTreePoints.h>

#include "support/Messages.h"
#include "support/SampleTrees.h"

#include <functional>
#include <limits>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

TEST(RefusedPoints, ATreeThatContradictsItselfIsNotWritten)
{
    const auto why = [](const SphereTree& tree) {
        return messageOf<openvdb::ValueError>([&] { toPoints(tree); });
    };
    EXPECT_TRUE(mentions(why(SphereTree()), "no nodes"));
    SphereTree tree = sampleTree();
    tree.subdivision = 4;
    EXPECT_TRUE(mentions(why(tree), "units of 1/4"));
    tree = sampleTree();
    tree.spheres.radius.pop_back();
    EXPECT_TRUE(mentions(why(tree), "entries in"));
    tree = sampleTree();
    tree.spheres.coverRadiusSq.pop_back();
    EXPECT_TRUE(mentions(why(tree), "entries in"));
    tree = sampleTree();
    tree.spheres.radiusWorld.push_back(1);
    EXPECT_TRUE(mentions(why(tree), "entries in"));
    tree = sampleTree();
    tree.spheres.parent.pop_back();
    EXPECT_TRUE(mentions(why(tree), "entries in"));
    tree = sampleTree();
    tree.ijk.pop_back();
    EXPECT_TRUE(mentions(why(tree), "entries in"));
    tree = sampleTree();
    tree.radiusSq.pop_back();
    EXPECT_TRUE(mentions(why(tree), "entries in"));
    tree = oneLevelOf(sampleTree(), 1);
    tree.levels[0].level = -1;
    EXPECT_TRUE(mentions(why(tree), "level -1 stands where level 0 belongs"));
    tree = sampleTree();
    for (SphereTreeLevel& level : tree.levels) ++level.level;
    EXPECT_TRUE(mentions(why(tree), "level 3 stands where level 2 belongs"));
    tree = sampleTree();
    tree.levels[1].end = 2;
    EXPECT_TRUE(mentions(why(tree), "level 0 is nodes 3 to 8 (exclusive)"))
        << "node 2 is on no level";
    tree = sampleTree();
    tree.levels[1].begin = tree.levels[1].end = tree.levels[0].begin;
    tree.levels[2].end = tree.levels[0].begin;
    EXPECT_TRUE(mentions(why(tree), "level 1 is nodes 3 to 3")) << "level 1 is empty";
    tree = sampleTree();
    tree.transform.reset();
    EXPECT_TRUE(mentions(why(tree), "transform"));
    tree = sampleTree();
    tree.levels[1].level = 2;
    EXPECT_TRUE(mentions(why(tree), "level 2 stands where level 1 belongs"));
    tree = sampleTree();
    tree.levels.pop_back();
    EXPECT_TRUE(mentions(why(tree), "where nodes from 0 on are expected"));
    tree = sampleTree();
    tree.settings.pyramid().factor = 1;
    EXPECT_TRUE(mentions(why(tree), "factor=1"));
    for (int32_t parent : {-1, 8, 99}) {
        tree = sampleTree();
        tree.dag.push_back({parent, 1});
        EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { dagToPoints(tree); }), "DAG"));
    }
}

TEST(RefusedPoints, WhatCouldNotBeReadBackIsNotWritten)
{
    const auto expectRefused = [](const std::function<void(SphereTree&)>& damage) {
        SphereTree tree = sampleTree();
        ASSERT_NO_THROW(toPoints(tree));
        damage(tree);
        EXPECT_THROW(toPoints(tree), openvdb::ValueError);
    };
    expectRefused(
        [](SphereTree& t) { t.spheres.radiusWorld[2] = std::numeric_limits<float>::infinity(); });
    expectRefused(
        [](SphereTree& t) { t.spheres.coverRadiusSq[2] = std::numeric_limits<int64_t>::max(); });
    expectRefused([](SphereTree& t) { t.spheres.center[2][1] = 1e10; });
    expectRefused([](SphereTree& t) { t.object.voxels = -1; });
    expectRefused([](SphereTree& t) { t.object.leaves = std::numeric_limits<int64_t>::max(); });
    expectRefused([](SphereTree& t) { t.object.tiles = -1; });
    expectRefused([](SphereTree& t) { t.object.bbox.reset({0, 0, 0}, {1, -2, 1}); });
    expectRefused([](SphereTree& t) { t.levels[1].pyramidVoxels = -1; });
    for (int64_t LevelError::*count :
        {&LevelError::covered, &LevelError::excess, &LevelError::missing}) {
        expectRefused([=](SphereTree& t) {
            t.levels[1].error = LevelError();
            (*t.levels[1].error).*count = -1;
        });
    }
    for (const double figure :
        {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        expectRefused([=](SphereTree& t) { t.levels[1].error = LevelError{1, 0, 0, figure, 0}; });
        expectRefused([=](SphereTree& t) { t.levels[1].error = LevelError{1, 0, 0, 0, figure}; });
        expectRefused([=](SphereTree& t) { t.levels[1].stored = StoredError{figure, 0}; });
        expectRefused([=](SphereTree& t) { t.levels[1].stored = StoredError{0, figure}; });
    }
    expectRefused([](SphereTree& t) { t.spheres.radius[2] = -1; });
    expectRefused([](SphereTree& t) { t.spheres.parent[5] = 1 << 30; });
    expectRefused([](SphereTree& t) { t.spheres.parent[5] = 4; });
    expectRefused([](SphereTree& t) { t.radiusSq[2] = 0; });
}

} // namespace
