// SPDX-License-Identifier: Apache-2.0
/// @file TestSphereCuts.cc
/// @brief Cuts of a small forest, by hand: which nodes, and as a tree.

#include <openvdb_spheretree/tree/SphereCuts.h>

#include "support/Messages.h"
#include "support/SampleTrees.h"

#include <gtest/gtest.h>

using namespace openvdb_spheretree;
using namespace spheretree_test;
using Nodes = std::vector<int32_t>;

TEST(SphereCuts, ACutIsTheNodesThatReachOverItsNumber)
{
    const SphereCuts cuts = tightSampleTree().cuts;
    EXPECT_EQ(cutNodes(cuts, 4), (Nodes{0, 1, 2, 3}));
    EXPECT_EQ(cutNodes(cuts, 3), (Nodes{2, 3, 4}));
    EXPECT_EQ(cutNodes(cuts, 2), (Nodes{3, 4}));
    EXPECT_EQ(cutNodes(cuts, 1), (Nodes{5}));
    for (int64_t none : {int64_t(0), int64_t(-1), int64_t(5), int64_t(1) << 40}) {
        EXPECT_EQ(cutNodes(cuts, none), Nodes()) << none;
    }
    EXPECT_EQ(cutNodes(SphereCuts(), 1), Nodes());
}

TEST(SphereCuts, ACutAsATreeIsOneLevelOfItsNodes)
{
    const SphereTree tree = tightSampleTree();
    for (int64_t spheres : {int64_t(1), int64_t(2), int64_t(3), int64_t(4), int64_t(1) << 40}) {
        SCOPED_TRACE(spheres);
        const SphereTree cut = cutTree(tree, spheres);
        const Nodes nodes = cutNodes(tree.cuts, std::min<int64_t>(spheres, 4));
        ASSERT_EQ(cut.size(), int32_t(nodes.size()));
        for (int32_t id = 0; id < cut.size(); ++id) {
            EXPECT_EQ(cut.spheres.center[id], tree.cuts.spheres.center[nodes[id]]);
            EXPECT_EQ(cut.spheres.radius[id], tree.cuts.spheres.radius[nodes[id]]);
            EXPECT_EQ(cut.spheres.coverRadiusSq[id], tree.cuts.spheres.coverRadiusSq[nodes[id]]);
            EXPECT_EQ(cut.spheres.radiusWorld[id], tree.cuts.spheres.radiusWorld[nodes[id]]);
            EXPECT_EQ(cut.spheres.parent[id], -1);
            EXPECT_EQ(cut.radiusSq[id], -1);
            EXPECT_EQ(cut.ijk[id], openvdb::Coord::round(cut.spheres.center[id]));
        }
        ASSERT_EQ(cut.levels.size(), 1u);
        EXPECT_EQ(cut.levels[0].level, 0);
        EXPECT_EQ(cut.levels[0].begin, 0);
        EXPECT_EQ(cut.levels[0].end, cut.size());
        EXPECT_EQ(cut.levels[0].pyramidVoxels, 0);
        EXPECT_TRUE(cut.cuts.empty());
        EXPECT_EQ(cut.subdivision, 16);
        SphereTree described = tree;
        described.hasCuts = false;
        expectSameDescription(cut, described);
        expectSameTransform(*cut.transform, *tree.transform);
        EXPECT_NE(cut.transform, tree.transform) << "of its own";
    }
}

TEST(SphereCuts, NoCutsOrNoSpheresAreErrorsThatSayWhatToDo)
{
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([] { cutTree(sampleTree(), 3); }), "build it with cuts=1"));
    for (int64_t spheres : {0, -7}) {
        EXPECT_TRUE(
            mentions(messageOf<openvdb::ValueError>([&] { cutTree(tightSampleTree(), spheres); }),
                "spheres=" + std::to_string(spheres) + " is out of range"));
    }
}

TEST(SphereCuts, ALevelThatIsKeptLosesTheCutsButNotTheUnits)
{
    const SphereTree kept = keepLevel(tightSampleTree(), 0);
    EXPECT_TRUE(kept.cuts.empty());
    EXPECT_FALSE(kept.hasCuts);
    EXPECT_EQ(kept.subdivision, 16);
    EXPECT_EQ(kept.spheres.center[1], tightSampleTree().spheres.center[2]);
}
