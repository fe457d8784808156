// SPDX-License-Identifier: Apache-2.0
/// @file TestReversibleTree.cc
/// @brief What is special about a reversible tree: all medial balls of all pyramid levels, each
/// level rebuilding its own. (Parents: TestTreesOracle.cc.)

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include "support/BuiltTrees.h"

#include <set>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

SphereTreeSettings reversible(int factor = 2, int dim = 3)
{
    SphereTreeSettings settings;
    setType(settings, TreeType::Reversible);
    settings.pyramid().factor = factor;
    settings.dim = dim;
    return settings;
}

/// The voxels of the digital balls of a level, on the level's own grid.
std::set<Coord> rebuilt(const SphereTree& tree, const SphereTreeLevel& level, int dim = 3)
{
    std::set<Coord> voxels;
    for (int32_t id = level.begin; id < level.end; ++id) {
        const int reach = int(std::sqrt(double(tree.radiusSq[id])));
        const Coord corner(reach, reach, dim == 2 ? 0 : reach);
        for (const Coord& v :
            voxelsOfBox(CoordBBox(tree.ijk[id] - corner, tree.ijk[id] + corner))) {
            if (squaredDistance(v, tree.ijk[id]) < tree.radiusSq[id]) voxels.insert(v);
        }
    }
    return voxels;
}

TEST(ReversibleTree, EveryLevelRebuildsItsOwnPyramidLevel)
{
    for (const RandomObject& object : someObjects(400, 44)) {
        for (int factor : {2, 3, 5}) {
            SCOPED_TRACE(object.name + ", factor " + std::to_string(factor));
            const auto pyramid = naiveOrPyramid(object.voxels, factor);
            const SphereTree tree = buildSphereTree(*gridOf(object.voxels), reversible(factor));
            for (const SphereTreeLevel& level : tree.levels) {
                ASSERT_EQ(rebuilt(tree, level), pyramid.at(level.level)) << "level " << level.level;
            }
        }
    }
}

TEST(ReversibleTree, EveryLevelRebuildsItsOwnPyramidLevelInTwoDimensions)
{
    for (const RandomObject& object : someObjects(500, 22)) {
        SCOPED_TRACE(object.name);
        const Voxels voxels = flattened(object.voxels);
        const auto pyramid = naiveOrPyramid(voxels, 2, 2);
        const SphereTree tree = buildSphereTree(*gridOf(voxels), reversible(2, 2));
        for (const SphereTreeLevel& level : tree.levels) {
            ASSERT_EQ(rebuilt(tree, level, 2), pyramid.at(level.level)) << "level " << level.level;
        }
    }
}

TEST(ReversibleTree, KeepsEveryMedialBallOfEveryLevel)
{
    for (const RandomObject& object : someObjects(600, 22)) {
        SCOPED_TRACE(object.name);
        const auto pyramid = naiveOrPyramid(object.voxels, 2);
        const SphereTree tree = buildSphereTree(*gridOf(object.voxels), reversible());
        for (const SphereTreeLevel& level : tree.levels) {
            const auto& voxels = pyramid.at(level.level);
            const auto balls = NaiveReference(Voxels(voxels.begin(), voxels.end())).balls();
            ASSERT_EQ(std::size_t(level.size()), balls.size());
            for (std::size_t i = 0; i < balls.size(); ++i) {
                ASSERT_EQ(tree.ijk[level.begin + int32_t(i)], balls[i].center);
                ASSERT_EQ(tree.radiusSq[level.begin + int32_t(i)], balls[i].radiusSq);
            }
        }
    }
}

TEST(ReversibleTree, EndsAtTheFirstLevelOfOneBall)
{
    const Voxels cross{
        {0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    EXPECT_EQ(buildSphereTree(*gridOf(cross), reversible()).levels.size(), 1u); // one ball
    for (const RandomObject& object : someObjects(700, 22)) {
        const SphereTree tree = buildSphereTree(*gridOf(object.voxels), reversible());
        for (std::size_t k = 0; k + 1 < tree.levels.size(); ++k) {
            EXPECT_GT(tree.levels[k].size(), 1) << object.name;
        }
        EXPECT_EQ(tree.root().size(), 1) << object.name;
    }
}

/// Two voxels in one parent voxel: radii by hand.
TEST(ReversibleTree, StoresTheSpheresOfTheFormula)
{
    SphereTreeSettings settings = reversible();
    const auto grid = gridOf(Voxels{Coord(0, 0, 0), Coord(1, 1, 0)});
    const SphereTree tight = buildSphereTree(*grid, settings);
    ASSERT_EQ(tight.size(), 3);
    EXPECT_EQ(tight.spheres.center[0], openvdb::Vec3d(0.5, 0.5, 0.5));
    EXPECT_DOUBLE_EQ(tight.spheres.radius[0], std::sqrt(3.0) / 2);
    EXPECT_EQ(tight.spheres.coverRadiusSq[0], 3);
    EXPECT_EQ(tight.spheres.radius[1], 0);
    settings.pyramid().scale = RadiusScale::Paper;
    const SphereTree paper = buildSphereTree(*grid, settings);
    EXPECT_DOUBLE_EQ(paper.spheres.radius[0], 2 + std::sqrt(3.0) / 2);
    EXPECT_EQ(paper.spheres.coverRadiusSq[0], 32); // (4 + sqrt 3)^2 = 32.86
    EXPECT_EQ(paper.spheres.radius[1], 0) << "level 0 is not scaled";
}

TEST(ReversibleTree, ParentsByDagAreDagParents)
{
    int others = 0;
    for (const RandomObject& object : someObjects(800, 33)) {
        SphereTreeSettings settings = reversible();
        settings.pyramid().dag = true;
        const SphereTree byCentre = buildSphereTree(*gridOf(object.voxels), settings);
        settings.pyramid().parent = ParentRule::Dag;
        const SphereTree tree = buildSphereTree(*gridOf(object.voxels), settings);
        for (int32_t id = 1; id < tree.size(); ++id) {
            const DagEdge edge{tree.spheres.parent[id], id};
            ASSERT_TRUE(std::binary_search(tree.dag.begin(), tree.dag.end(), edge)) << object.name;
            others += tree.spheres.parent[id] != byCentre.spheres.parent[id];
        }
    }
    EXPECT_GT(others, 100) << "the rules hardly differ on these objects";
}

TEST(ReversibleTree, OfItsDagParentsANodeHasTheOneOfLeastCoveringPowerAndOfEqualsTheFirst)
{
    int choices = 0, ties = 0;
    for (const RandomObject& object : someObjects(900, 33)) {
        for (int factor : {2, 3}) {
            SCOPED_TRACE(object.name + ", factor " + std::to_string(factor));
            SphereTreeSettings settings = reversible(factor);
            settings.pyramid().dag = true;
            settings.pyramid().parent = ParentRule::Dag;
            const SphereTree tree = buildSphereTree(*gridOf(object.voxels), settings);
            const auto power = [&](int32_t parent, int32_t child) {
                const double apart =
                    (tree.spheres.center[parent] - tree.spheres.center[child]).length();
                return apart + tree.spheres.radius[child] - tree.spheres.radius[parent];
            };
            std::vector<int32_t> expected(tree.spheres.parent.size(), -1);
            for (const DagEdge& edge : tree.dag) { // by parent
                int32_t& best = expected[edge.child];
                choices += best >= 0;
                ties += best >= 0 && power(edge.parent, edge.child) == power(best, edge.child);
                if (best < 0 || power(edge.parent, edge.child) < power(best, edge.child)) {
                    best = edge.parent;
                }
            }
            ASSERT_EQ(tree.spheres.parent, expected);
        }
    }
    EXPECT_GT(choices, 1000);
    EXPECT_GT(ties, 10);
}

} // namespace
