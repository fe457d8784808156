// SPDX-License-Identifier: Apache-2.0
/// @file TestIntersectionDag.cc
/// @brief Edges between all spheres of consecutive levels that meet, against every pair.

#include "support/BuiltTrees.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/paper/IntersectionDag.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// Two levels: one sphere above, the others below it. Radii are roots of coverSq, halved.
SphereTree starOf(const std::vector<std::pair<openvdb::Vec3d, int64_t>>& spheres)
{
    SphereTree tree;
    tree.settings.kind = ExtendedOptions();
    for (const auto& [center, coverSq] : spheres) {
        tree.spheres.center.push_back(center);
        tree.spheres.coverRadiusSq.push_back(coverSq);
        tree.spheres.radius.push_back(std::sqrt(double(coverSq)) / 2);
    }
    tree.levels.resize(2);
    tree.levels[0].begin = 1;
    tree.levels[0].end = tree.size();
    tree.levels[1].level = 1;
    tree.levels[1].end = 1;
    return tree;
}

std::vector<DagEdge> allPairsThatMeet(const SphereTree& tree)
{
    std::vector<DagEdge> edges;
    for (std::size_t k = 1; k < tree.levels.size(); ++k) {
        for (int32_t t = tree.levels[k].begin; t < tree.levels[k].end; ++t) {
            for (int32_t s = tree.levels[k - 1].begin; s < tree.levels[k - 1].end; ++s) {
                const auto apartSq =
                    double((2 * (tree.spheres.center[s] - tree.spheres.center[t])).lengthSqr());
                const long double reach = std::sqrt((long double)tree.spheres.coverRadiusSq[s])
                    + std::sqrt((long double)tree.spheres.coverRadiusSq[t]);
                if (std::sqrt((long double)apartSq) <= reach + 1e-12L) edges.push_back({t, s});
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

} // namespace

TEST(IntersectionDag, SpheresThatTouchMeetAndOthersDoNot)
{
    // Radius 2 at the origin; 3 at a distance of 5; the same half a voxel further away.
    EXPECT_EQ(intersectionDag(starOf({{{0, 0, 0}, 16}, {{3, 4, 0}, 36}})).size(), 1u);
    EXPECT_TRUE(intersectionDag(starOf({{{0, 0, 0}, 16}, {{3.5, 4, 0}, 36}})).empty());
    EXPECT_TRUE(intersectionDag(starOf({{{0, 0, 0}, 16}, {{3, 4, 0}, 35}})).empty());
    // One inside the other, and points.
    EXPECT_EQ(intersectionDag(starOf({{{0, 0, 0}, 1600}, {{1, 0, 0}, 1}})).size(), 1u);
    EXPECT_EQ(intersectionDag(starOf({{{7, 0, 0}, 0}, {{7, 0, 0}, 0}})).size(), 1u);
    EXPECT_TRUE(intersectionDag(starOf({{{7, 0, 0}, 0}, {{7.5, 0, 0}, 0}})).empty());
}

TEST(IntersectionDag, CountsInTheTreesUnits)
{
    for (const int64_t less : {0, 1}) {
        SphereTree tree = starOf({{{0.0625, 0, 0}, 32 * 32}, {{3.0625, 4, 0}, 48 * 48 - less}});
        tree.subdivision = 16;
        EXPECT_EQ(intersectionDag(tree).size(), less == 0 ? 1u : 0u);
    }
}

TEST(IntersectionDag, IsExactAtTheLargestCoordinates)
{
    const int64_t far = int64_t(1) << 29, diameter = far * 2;
    const openvdb::Vec3d a(-double(far), 0, 0), b(double(far), 0, 0);
    // Radii of 2^29 each, centres 2^30 apart: they touch; a hair less, and they do not.
    EXPECT_EQ(
        intersectionDag(starOf({{a, diameter * diameter}, {b, diameter * diameter}})).size(), 1u);
    EXPECT_TRUE(
        intersectionDag(starOf({{a, diameter * diameter}, {b, diameter * diameter - 1}})).empty());
}

TEST(IntersectionDag, CubesMeetAtTheirCorners)
{
    for (const double apart : {4.0, 4.5}) {
        SphereTree tree = starOf({{{0, 0, 0}, 16}, {{4, apart, 4}, 16}});
        tree.settings.pyramid().dist = distanceFromString("linf");
        EXPECT_EQ(intersectionDag(tree).size(), apart == 4 ? 1u : 0u);
    }
    const openvdb::Vec3d far(1000, 1000, 1000);
    SphereTree tree = starOf({{{0, 0, 0}, 4000000}, {far, 0}}); // far outside the Euclidean ball
    tree.settings.pyramid().dist = distanceFromString("linf");
    EXPECT_EQ(intersectionDag(tree).size(), 1u);
}

TEST(IntersectionDag, IsEveryPairThatMeets)
{
    for (uint32_t seed = 0; seed < 20; ++seed) {
        const RandomObject object = randomObject(seed);
        for (const TreeType type : {TreeType::Reversible, TreeType::Extended}) {
            SphereTreeSettings settings;
            setType(settings, type);
            const SphereTree tree = buildSphereTree(*gridOf(object.voxels), settings);
            EXPECT_TRUE(intersectionDag(tree) == allPairsThatMeet(tree)) << object.name;
        }
    }
}

TEST(IntersectionDag, HoldsTheEdgesOfSharedVoxelsOfAReversibleTree)
{
    for (uint32_t seed = 100; seed < 160; ++seed) {
        const RandomObject object = randomObject(seed);
        SphereTreeSettings settings;
        setType(settings, TreeType::Reversible);
        settings.pyramid().dag = true;
        settings.pyramid().factor = 2 + int(seed % 2);
        settings.dim = seed % 3 ? 3 : 2;
        const Voxels voxels = settings.dim == 3 ? object.voxels : flattened(object.voxels);
        const SphereTree shared = buildSphereTree(*gridOf(voxels), settings);
        settings.pyramid().edges = DagEdges::Intersecting;
        const SphereTree meeting = buildSphereTree(*gridOf(voxels), settings);
        EXPECT_TRUE(meeting.dag == intersectionDag(shared)) << object.name;
        EXPECT_TRUE(std::includes(
            meeting.dag.begin(), meeting.dag.end(), shared.dag.begin(), shared.dag.end()))
            << object.name;
        EXPECT_EQ(meeting.spheres.parent, shared.spheres.parent) << object.name;
    }
}

/// A small case of what docs/algorithm.md explains: a sphere that was fitted to its leaf balls need
/// not hold all of its cell.
TEST(IntersectionDag, LacksAnEdgeOfSharedVoxelsOfAnExtendedTree)
{
    const RandomObject object = randomObject(70);
    SphereTreeSettings settings = extendedTree();
    settings.pyramid().dag = true;
    const auto lacking = [&] {
        const SphereTree tree = buildSphereTree(*gridOf(object.voxels), settings);
        const std::vector<DagEdge> meeting = intersectionDag(tree);
        std::vector<DagEdge> lacks;
        std::set_difference(tree.dag.begin(), tree.dag.end(), meeting.begin(), meeting.end(),
            std::back_inserter(lacks));
        return lacks.size();
    };
    EXPECT_EQ(lacking(), 1u) << object.name;
    settings.extended().finalFit = false;
    EXPECT_EQ(lacking(), 0u) << "the whole cell lies in the sphere";
}

TEST(IntersectionDag, IsCheckedWithTheTree)
{
    for (const DagEdges edges : {DagEdges::Shared, DagEdges::Intersecting}) {
        const auto object = gridOf(shapes::ball(30));
        SphereTreeSettings settings = extendedTree();
        settings.pyramid().dag = true;
        settings.pyramid().edges = edges;
        SphereTree tree = buildSphereTree(*object, settings);
        ASSERT_TRUE(checkSphereTree(tree, *object).empty()) << toString(edges);
        const DagEdge first = tree.dag.front();
        tree.dag.erase(tree.dag.begin());
        const std::string place =
            std::to_string(first.parent) + " to " + std::to_string(first.child) + ')';
        const std::vector<TreeFault> faults = checkSphereTree(tree, *object);
        ASSERT_EQ(faults.size(), 1u);
        EXPECT_EQ(toString(faults[0].kind), "edges");
        EXPECT_EQ(faults[0].sentence, "the DAG lacks 1 edge (first: " + place);
    }
}

TEST(IntersectionDag, AnEdgeThatNoVoxelWitnessesIsReported)
{
    const auto object = gridOf(shapes::box(openvdb::Coord(40, 3, 3)));
    SphereTreeSettings settings;
    setType(settings, TreeType::Reversible);
    settings.pyramid().dag = true;
    settings.pyramid().edges = DagEdges::Intersecting;
    SphereTree tree = buildSphereTree(*object, settings);
    tree.settings.pyramid().edges = DagEdges::Shared;
    const auto faults = checkSphereTree(tree, *object);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].sentence.rfind("the DAG should lack ", 0), 0u) << faults[0].sentence;
}
