// SPDX-License-Identifier: Apache-2.0
/// @file TestTraversal.cc
/// @brief Children of nodes against the list of parents, and visits from the root down.

#include "support/BuiltTrees.h"
#include "support/Messages.h"
#include "support/RandomObjects.h"
#include "support/SampleTrees.h"
#include "support/TreeSettings.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/tree/Traversal.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

std::vector<SphereTree> trees()
{
    std::vector<SphereTree> all{sampleTree(), tightSampleTree(), oneVoxelTree()};
    for (uint32_t seed = 1; seed < 4; ++seed) {
        for (const TreeType type : {TreeType::Reversible, TreeType::Extended, TreeType::Tight}) {
            SphereTreeSettings settings;
            setType(settings, type);
            all.push_back(buildSphereTree(*gridOf(randomObject(seed).voxels), settings));
        }
    }
    return all;
}

} // namespace

TEST(Traversal, ChildrenAreThoseThatNameTheNodeAsParent)
{
    for (const SphereTree& tree : trees()) {
        const CompressedRows rows = children(tree);
        ASSERT_EQ(rows.rowCount(), std::size_t(tree.size()));
        std::size_t links = 0;
        for (int32_t id = 0; id < tree.size(); ++id) {
            const NodeSpan row = rows[id];
            EXPECT_TRUE(std::is_sorted(row.begin(), row.end()));
            for (const int32_t child : row) ASSERT_EQ(tree.spheres.parent[child], id);
            links += row.size();
        }
        const auto& parents = tree.spheres.parent;
        EXPECT_EQ(links, parents.size() - std::count(parents.begin(), parents.end(), -1));
    }
}

TEST(Traversal, AVisitThatAlwaysDescendsSeesEveryNodeOnceAndParentsFirst)
{
    for (const SphereTree& tree : trees()) {
        std::vector<int32_t> order;
        visitSpheres(tree, [&](int32_t id) {
            order.push_back(id);
            return true;
        });
        std::vector<int32_t> place(std::size_t(tree.size()), -1);
        for (std::size_t i = 0; i < order.size(); ++i) {
            ASSERT_EQ(place[order[i]], -1);
            place[order[i]] = int32_t(i);
            const int32_t parent = tree.spheres.parent[order[i]];
            if (parent >= 0) {
                ASSERT_GE(place[parent], 0);
            }
        }
        EXPECT_EQ(order.size(), std::size_t(tree.size()));
    }
}

TEST(Traversal, NothingBelowANodeThatIsLeftOutIsVisited)
{
    const SphereTree tree = sampleTree();
    const CompressedRows rows = children(tree);
    const int32_t closed = tree.levels[1].begin;
    std::vector<int32_t> expected, visited;
    for (int32_t id = 0; id < tree.size(); ++id) {
        bool below = false;
        for (int32_t up = tree.spheres.parent[id]; up >= 0; up = tree.spheres.parent[up]) {
            below = below || up == closed;
        }
        if (!below) expected.push_back(id);
    }
    ASSERT_LT(expected.size(), std::size_t(tree.size()));
    visitSpheres(tree, rows, [&](int32_t id) {
        visited.push_back(id);
        return id != closed;
    });
    std::sort(visited.begin(), visited.end());
    EXPECT_EQ(visited, expected);
}

TEST(Traversal, AParentThatIsNoNodeIsAnErrorThatNamesIt)
{
    for (const int32_t parent : {-2, 8}) {
        SphereTree tree = sampleTree();
        tree.spheres.parent[5] = parent;
        EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { children(tree); }),
            "node 5 has the parent " + std::to_string(parent)));
    }
}
