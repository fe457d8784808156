// SPDX-License-Identifier: Apache-2.0
/// @file TestExtendedTree.cc
/// @brief What is special about an extended tree: radii that the leaf balls need, balls without
/// children dropped, levels rebuilt from their spheres.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include "support/BuiltTrees.h"
#include "support/Messages.h"

#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/paper/TreeLevels.h>

#include <algorithm>
#include <set>
#include <utility>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

SphereTreeSettings extended(Reconstruction reconstruct = Reconstruction::Clip, int factor = 2)
{
    SphereTreeSettings settings = extendedTree();
    settings.extended().reconstruct = reconstruct;
    settings.pyramid().factor = factor;
    return settings;
}

const std::vector<Reconstruction> kReconstructions{
    Reconstruction::Clip, Reconstruction::Free, Reconstruction::None};

/// Per node: the radius that contains the leaf balls below it, around the node's own centre.
std::vector<double> neededRadii(const SphereTree& tree)
{
    std::vector<double> needed(tree.spheres.radius.size(), -1);
    for (int32_t leaf = tree.levels[0].begin; leaf < tree.levels[0].end; ++leaf) {
        for (int32_t id = leaf; id >= 0; id = tree.spheres.parent[id]) {
            const double apart = (tree.spheres.center[leaf] - tree.spheres.center[id]).length();
            needed[id] = std::max(needed[id], apart + tree.spheres.radius[leaf]);
        }
    }
    return needed;
}

TEST(ExtendedTree, RadiiAreTheSmallestThatContainTheLeafBallsBelow)
{
    for (const RandomObject& object : someObjects(400, 33)) {
        for (const Reconstruction reconstruct : kReconstructions) {
            SCOPED_TRACE(object.name + ", " + toString(reconstruct));
            const SphereTree tree = buildSphereTree(*gridOf(object.voxels), extended(reconstruct));
            const std::vector<double> needed = neededRadii(tree);
            for (int32_t id = 0; id < tree.size(); ++id) {
                ASSERT_NEAR(tree.spheres.radius[id], needed[id], 1e-9 * (1 + needed[id])) << id;
            }
        }
    }
}

/// From the root's center, at 511.5, one ball reaches (sqrt(2221347) + 6) / 2 far, the other
/// (sqrt(2230811) + sqrt(8)) / 2, which is more by two parts in 10^14.
TEST(ExtendedTree, TheRadiusIsTheLargestAlsoWhereAnotherBallReachesNearlyAsFar)
{
    const std::pair<Coord, Coord> kCenters[] = {
        {Coord(952, 124, 52), Coord(61, 878, 981)}, {Coord(241, 22, 19), Coord(876, 991, 953)}};
    for (const auto& [first, second] : kCenters) {
        Voxels voxels{Coord(0, 511, 511), Coord(511, 0, 511), Coord(511, 511, 0)}; // the box begins
        for (const Coord& q : shapes::ball(10)) voxels.push_back(q + first);
        for (const Coord& q : shapes::ball(3)) voxels.push_back(q + second);
        sortVoxels(voxels);
        const SphereTree tree = buildSphereTree(*gridOf(voxels), extended());
        ASSERT_EQ(tree.levels[0].size(), 5);
        ASSERT_EQ(tree.spheres.center[0], openvdb::Vec3d(511.5));
        const long double needed = (std::sqrt(2230811.0L) + std::sqrt(8.0L)) / 2;
        EXPECT_GE((long double)(tree.spheres.radius[0]), needed) << first;
        EXPECT_LE((long double)(tree.spheres.radius[0]), needed * (1 + 1e-15L)) << first;
    }
}

TEST(ExtendedTree, WithoutTheFinalFitRadiiGrowAsAnyBallsDoAndNothingElseChanges)
{
    for (const RandomObject& object : someObjects(500, 33)) {
        SCOPED_TRACE(object.name);
        SphereTreeSettings settings = extended();
        const SphereTree fitted = buildSphereTree(*gridOf(object.voxels), settings);
        settings.extended().finalFit = false;
        const SphereTree tree = buildSphereTree(*gridOf(object.voxels), settings);
        ASSERT_EQ(tree.ijk, fitted.ijk);
        ASSERT_EQ(tree.spheres.parent, fitted.spheres.parent);
        for (int32_t id = 0; id < tree.size(); ++id) {
            const double side = std::pow(2.0, tree.levelOf(id)) - 1;
            const double radius = fitted.spheres.radius[id] + std::sqrt(3.0) / 2 * side;
            ASSERT_NEAR(tree.spheres.radius[id], radius, 1e-9 * (1 + radius));
            ASSERT_GE(tree.spheres.coverRadiusSq[id], fitted.spheres.coverRadiusSq[id]);
            ASSERT_LE(double(tree.spheres.coverRadiusSq[id]), 4 * radius * radius * (1 + 1e-12));
            ASSERT_GT(
                double(tree.spheres.coverRadiusSq[id]) + 1, 4 * radius * radius * (1 - 1e-12));
        }
    }
}

TEST(ExtendedTree, EveryInnerNodeHasAChild)
{
    for (const RandomObject& object : someObjects(600, 33)) {
        for (const SphereTreeSettings& settings : allSettings(TreeType::Extended, 3)) {
            const SphereTree tree = buildSphereTree(*gridOf(object.voxels), settings);
            std::vector<int> children(tree.spheres.parent.size(), 0);
            for (int32_t parent : tree.spheres.parent) {
                if (parent >= 0) ++children[parent];
            }
            for (int32_t id = 0; id < tree.levels[0].begin; ++id) {
                ASSERT_GT(children[id], 0) << object.name << ' ' << describe(settings);
            }
        }
    }
}

TEST(ExtendedTree, DropsBallsThatAReversibleTreeKeeps)
{
    int dropped = 0;
    for (const RandomObject& object : someObjects(700, 33)) {
        SphereTreeSettings settings = extended();
        const SphereTree tree = buildSphereTree(*gridOf(object.voxels), settings);
        setType(settings, TreeType::Reversible);
        const SphereTree all = buildSphereTree(*gridOf(object.voxels), settings);
        if (tree.levels.size() < 2) continue;
        ASSERT_LE(tree.levels[1].size(), all.levels[1].size()) << object.name;
        dropped += all.levels[1].size() - tree.levels[1].size();
        // Level 1 comes from the same voxels in both.
        EXPECT_EQ(tree.levels[1].pyramidVoxels, all.levels[1].pyramidVoxels);
    }
    EXPECT_GT(dropped, 50);
}

using EdgesByCenter = std::set<std::pair<Coord, Coord>>; ///< center of the parent, of the child

/// The edges from level 1 to 0, of parents that another tree has on its level 1.
EdgesByCenter firstEdges(const SphereTree& tree, const SphereTree& other)
{
    const auto level1 = [](const SphereTree& of) {
        return std::set<Coord>(
            of.ijk.begin() + of.level(1).begin, of.ijk.begin() + of.level(1).end);
    };
    const std::set<Coord> kept = level1(other);
    EdgesByCenter edges;
    for (const DagEdge& edge : tree.dag) {
        if (edge.child < tree.levels[0].begin || !kept.count(tree.ijk[edge.parent])) continue;
        EXPECT_TRUE(edges.emplace(tree.ijk[edge.parent], tree.ijk[edge.child]).second) << "twice";
    }
    return edges;
}

TEST(ExtendedTree, TheDagIsThatOfTheReversibleTreeWithoutTheDroppedBalls)
{
    std::size_t dropped = 0;
    for (const RandomObject& object : someObjects(750, 33)) {
        SphereTreeSettings settings = extended();
        settings.pyramid().dag = true;
        const SphereTree tree = buildSphereTree(*gridOf(object.voxels), settings);
        setType(settings, TreeType::Reversible);
        const SphereTree all = buildSphereTree(*gridOf(object.voxels), settings);
        if (tree.levels.size() < 2) continue;
        const EdgesByCenter edges = firstEdges(tree, tree);
        EXPECT_EQ(edges, firstEdges(all, tree)) << object.name;
        dropped += firstEdges(all, all).size() - edges.size();
    }
    EXPECT_GT(dropped, 50u);
}

/// Per level, the box of the object's OR pyramid.
std::vector<CoordBBox> pyramidBoxes(const Voxels& voxels)
{
    std::vector<CoordBBox> boxes;
    for (const auto& level : naiveOrPyramid(voxels, 2)) {
        boxes.push_back(boxOf(Voxels(level.begin(), level.end())));
    }
    return boxes;
}

TEST(ExtendedTree, TheClipKeepsLevelsInThePyramidsBoxAndTheirNumberInItsBound)
{
    for (const RandomObject& object : someObjects(800, 44)) {
        SCOPED_TRACE(object.name);
        const SphereTree tree = buildSphereTree(*gridOf(object.voxels), extended());
        const auto boxes = pyramidBoxes(object.voxels);
        ASSERT_LE(tree.levels.size(), boxes.size());
        for (const SphereTreeLevel& level : tree.levels) {
            const CoordBBox& box = boxes[level.level];
            EXPECT_LE(level.pyramidVoxels, int64_t(box.volume()));
            for (int32_t id = level.begin; id < level.end; ++id) {
                ASSERT_TRUE(box.isInside(tree.ijk[id])) << tree.ijk[id];
            }
        }
    }
}

TEST(ExtendedTree, WithoutTheClipLevelsMaySwellButTheTreeStillEnds)
{
    int swollen = 0;
    for (const RandomObject& object : someObjects(900, 44)) {
        SCOPED_TRACE(object.name);
        const SphereTree clipped = buildSphereTree(*gridOf(object.voxels), extended());
        const SphereTree tree =
            buildSphereTree(*gridOf(object.voxels), extended(Reconstruction::Free));
        EXPECT_TRUE(endsAtOneRoot(tree));
        EXPECT_LE(tree.levels.size(), pyramidBoxes(object.voxels).size());
        for (std::size_t k = 0; k < std::min(tree.levels.size(), clipped.levels.size()); ++k) {
            swollen += tree.levels[k].pyramidVoxels > clipped.levels[k].pyramidVoxels;
        }
    }
    EXPECT_GT(swollen, 10);
}

TEST(ExtendedTree, WithoutReconstructionLevelsAreThoseOfThePyramid)
{
    for (const RandomObject& object : someObjects(1000, 44)) {
        SCOPED_TRACE(object.name);
        const SphereTree tree =
            buildSphereTree(*gridOf(object.voxels), extended(Reconstruction::None));
        const auto pyramid = naiveOrPyramid(object.voxels, 2);
        for (const SphereTreeLevel& level : tree.levels) {
            EXPECT_EQ(level.pyramidVoxels, int64_t(pyramid.at(level.level).size()));
        }
    }
}

TEST(ExtendedTree, Level0IsThatOfTheReversibleTree)
{
    for (const RandomObject& object : someObjects(1100, 11)) {
        SphereTreeSettings settings = extended();
        SphereTree a = keepLevel(buildSphereTree(*gridOf(object.voxels), settings), 0);
        setType(settings, TreeType::Reversible);
        SphereTree b = keepLevel(buildSphereTree(*gridOf(object.voxels), settings), 0);
        EXPECT_TRUE(sameNodes(a, b)) << object.name;
    }
}

TEST(ExtendedTree, TheRadiusScaleDoesNotMatterToFittedSpheres)
{
    const auto grid = gridOf(randomObject(8).voxels);
    SphereTreeSettings settings = extended();
    const SphereTree tight = buildSphereTree(*grid, settings);
    settings.pyramid().scale = RadiusScale::Paper;
    EXPECT_TRUE(sameNodes(tight, buildSphereTree(*grid, settings)));
}

/// A row of eight voxels, by hand: level 1 is a row of four, whose medial balls are its voxels.
TEST(ExtendedTree, ARowOfVoxelsIsWhatItIsByHand)
{
    SphereTreeSettings settings = extended();
    settings.padding = 0;
    const SphereTree tree = buildSphereTree(*gridOf(shapes::box(Coord(8, 1, 1))), settings);
    ASSERT_EQ(tree.levels.size(), 4u);
    EXPECT_EQ(tree.levels[1].size(), 4);
    EXPECT_EQ(tree.levels[2].size(), 2);
    for (int32_t i = 0; i < 4; ++i) { // two voxels each, at (2i, 0, 0) and (2i + 1, 0, 0)
        const int32_t id = tree.levels[1].begin + i;
        EXPECT_EQ(tree.spheres.center[id], openvdb::Vec3d(2 * i + 0.5, 0.5, 0.5));
        EXPECT_DOUBLE_EQ(tree.spheres.radius[id], std::sqrt(3.0) / 2);
        EXPECT_EQ(tree.spheres.coverRadiusSq[id], 3);
    }
    const int32_t first = tree.levels[2].begin; // four voxels, the farthest at (0, 0, 0)
    EXPECT_EQ(tree.spheres.center[first], openvdb::Vec3d(1.5, 1.5, 1.5));
    EXPECT_DOUBLE_EQ(tree.spheres.radius[first], std::sqrt(27.0) / 2);
    EXPECT_EQ(tree.spheres.center[0], openvdb::Vec3d(3.5, 3.5, 3.5));
    EXPECT_DOUBLE_EQ(tree.spheres.radius[0], std::sqrt(3 * 49.0) / 2);
}

TEST(ExtendedTree, IsRefusedBeforeItHasMoreNodesThanIdsOrMemory)
{
    EXPECT_NO_THROW(detail::requireRoomForNodes(1000000));
    constexpr std::size_t kIds = std::size_t(1) << 31, kNodeBytes = 64;
    const auto refused = [](std::size_t nodes) {
        return messageOf<openvdb::ValueError>([&] { detail::requireRoomForNodes(nodes); });
    };
    EXPECT_TRUE(mentions(refused(kIds), "the 2147483648 spheres of the tree"));
    EXPECT_TRUE(mentions(refused(kIds), "more than the 2147483647 that it can have"));

    const double there = detail::physicalMemory();
    ASSERT_GT(there, 0) << "a machine that does not say what memory it has";
    const std::size_t fit = std::min(kIds - 1, std::size_t(there / kNodeBytes));
    EXPECT_NO_THROW(detail::requireRoomForNodes(fit));
    if (fit < kIds - 1) { // below 128 GiB memory ends before ids do
        EXPECT_TRUE(mentions(refused(fit + 1), "GiB of this machine"));
    }
}

} // namespace
