// SPDX-License-Identifier: Apache-2.0
/// @file TestDagAdjacency.cc
/// @brief Rows of a DAG's edges, and counts of them, against the list of edges.

#include "support/BuiltTrees.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/tree/DagAdjacency.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

std::vector<DagEdge> randomEdges(int parents, int children, double rate, Random& random)
{
    std::vector<DagEdge> edges;
    for (int t = 0; t < parents; ++t) {
        for (int s = 0; s < children; ++s) {
            if (random.chance(rate)) edges.push_back({t, s});
        }
    }
    return edges;
}

SphereTree randomTree(uint32_t seed, TreeType type, DagEdges edges)
{
    SphereTreeSettings settings;
    setType(settings, type);
    settings.pyramid().factor = 2 + int(seed % 2);
    settings.pyramid().dag = true;
    settings.pyramid().edges = edges;
    return buildSphereTree(*gridOf(randomObject(seed).voxels), settings);
}

void expectStats(const SphereTree& tree, std::size_t k, const DagLevelStats& stats)
{
    const SphereTreeLevel &below = tree.levels[k], &above = tree.levels[k + 1];
    std::vector<int64_t> parents(std::size_t(tree.size())), children(std::size_t(tree.size()));
    int64_t edges = 0, links = 0;
    for (const DagEdge& edge : tree.dag) {
        if (edge.child < below.begin || edge.child >= below.end) continue;
        ++edges;
        ++parents[std::size_t(edge.child)];
        ++children[std::size_t(edge.parent)];
        links += tree.spheres.parent[std::size_t(edge.child)] == edge.parent;
    }
    const auto expectDegrees = [](const std::vector<int64_t>& counts, const SphereTreeLevel& level,
                                   int64_t sum, const Degrees& degrees) {
        const auto range =
            std::minmax_element(counts.begin() + level.begin, counts.begin() + level.end);
        EXPECT_EQ(degrees.min, *range.first);
        EXPECT_EQ(degrees.max, *range.second);
        EXPECT_DOUBLE_EQ(degrees.mean, double(sum) / level.size());
    };
    EXPECT_EQ(stats.level, below.level);
    EXPECT_EQ(stats.edges, edges);
    expectDegrees(children, above, edges, stats.childrenPerParent);
    expectDegrees(parents, below, edges, stats.parentsPerChild);
    EXPECT_EQ(stats.sharedChildren,
        std::count_if(parents.begin(), parents.end(), [](int64_t n) { return n > 1; }));
    EXPECT_DOUBLE_EQ(stats.treeEdgesInDagPercent, 100.0 * double(links) / below.size());
}

} // namespace

TEST(DagAdjacency, RowsHoldTheEdgesInBothDirections)
{
    Random random(7);
    for (int round = 0; round < 50; ++round) {
        const int parents = random.between(1, 12), children = random.between(1, 30);
        const auto edges = randomEdges(parents, children, round % 5 * 0.25, random);
        const DagAdjacency rows = dagAdjacency(edges, parents, children);
        ASSERT_EQ(rows.children.rowCount(), std::size_t(parents));
        ASSERT_EQ(rows.parents.rowCount(), std::size_t(children));
        EXPECT_EQ(rows.edgeCount(), edges.size());
        std::vector<DagEdge> down, up;
        for (int t = 0; t < parents; ++t) {
            for (const int32_t s : rows.children[t]) down.push_back({t, s});
        }
        for (int s = 0; s < children; ++s) {
            const NodeSpan row = rows.parents[s];
            EXPECT_TRUE(std::is_sorted(row.begin(), row.end()));
            for (std::size_t i = 0; i < row.size(); ++i) up.push_back({row[i], s});
        }
        EXPECT_TRUE(down == edges);
        std::sort(up.begin(), up.end());
        EXPECT_TRUE(up == edges);
    }
}

TEST(DagAdjacency, RefusesEdgesThatAreOutOfOrderTwiceThereOrBetweenNoNodes)
{
    EXPECT_EQ(dagAdjacency({}, 0, 0).edgeCount(), 0u);
    EXPECT_NO_THROW(dagAdjacency({{0, 0}, {0, 1}, {1, 0}}, 2, 2));
    const std::vector<std::vector<DagEdge>> wrong = {{{0, 1}, {0, 0}}, {{1, 0}, {0, 1}},
        {{0, 1}, {0, 1}}, {{-1, 0}}, {{0, -1}}, {{2, 0}}, {{0, 2}}};
    for (const auto& edges : wrong) EXPECT_THROW(dagAdjacency(edges, 2, 2), openvdb::ValueError);
    EXPECT_THROW(dagAdjacency({}, -1, 2), openvdb::ValueError);
}

TEST(DagAdjacency, OfATreeRefusesEdgesThatSkipALevel)
{
    SphereTree tree = buildSphereTree(*gridOf(shapes::box(Coord(40, 9, 9))), extendedTree());
    ASSERT_GT(tree.levels.size(), 2u);
    tree.dag = {{tree.levels[2].begin, tree.levels[1].begin}};
    EXPECT_NO_THROW(dagAdjacency(tree));
    tree.dag = {{tree.levels[2].begin, tree.levels[0].begin}};
    EXPECT_THROW(dagAdjacency(tree), openvdb::ValueError);
    tree.dag = {{tree.levels[0].begin, tree.levels[0].begin + 1}};
    EXPECT_THROW(dagAdjacency(tree), openvdb::ValueError);
}

TEST(DagAdjacency, StatsCountTheEdgesOfEveryLevel)
{
    for (uint32_t seed = 0; seed < 24; ++seed) {
        const auto type = seed % 3 ? TreeType::Reversible : TreeType::Extended;
        const auto edges = seed % 4 ? DagEdges::Shared : DagEdges::Intersecting;
        const SphereTree tree = randomTree(seed, type, edges);
        const std::vector<DagLevelStats> stats = dagStats(tree);
        if (tree.levels.size() == 1) continue;
        ASSERT_EQ(stats.size(), tree.levels.size() - 1);
        for (std::size_t k = 0; k < stats.size(); ++k) expectStats(tree, k, stats[k]);
    }
}

TEST(DagAdjacency, ATreeWithoutEdgesHasNoStats)
{
    EXPECT_TRUE(dagStats(buildSphereTree(*gridOf(shapes::ball(30)))).empty());
}
