// SPDX-License-Identifier: Apache-2.0
/// @file TestTightCheck.cc
/// @brief What the check says of tight trees: each thing that must hold is broken once in a small
/// one written by hand.

#include <openvdb_spheretree/check/TreeCheck.h>

#include "support/CheckedTrees.h"
#include "support/CoreStages.h"
#include "support/TightSamples.h"
#include "support/TreeSettings.h"

#include <openvdb_spheretree/measure/LevelErrors.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <functional>
#include <string>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::BoolGrid;
using Change = std::function<void(SphereTree&)>;

/// @param nodes    of a tree, or its cuts
/// @param radius2  the radius, squared, in voxels
void add(openvdb_spheretree::Spheres& nodes, const SphereTree& tree, const openvdb::Vec3d& center,
    double radius2, int parent)
{
    nodes.center.push_back(center);
    nodes.coverRadiusSq.push_back(int64_t(256 * radius2));
    nodes.radius.push_back(std::sqrt(double(nodes.coverRadiusSq.back())) / 16);
    nodes.radiusWorld.push_back(
        floatAbove((nodes.radius.back() + tree.settings.paddingVoxels()) * tree.voxelSize()));
    nodes.parent.push_back(parent);
}

/// Cuts of one and two spheres.
void addCuts(SphereTree& tree)
{
    add(tree.cuts.spheres, tree, {2, 2, 2}, 1, 2);
    add(tree.cuts.spheres, tree, {9, 2, 2}, 0, 2);
    add(tree.cuts.spheres, tree, {5, 2, 2}, 16, -1);
    tree.cuts.first = {2, 2, 1};
    tree.cuts.last = {2, 2, 1};
    tree.hasCuts = true;
}

/// Three levels of 1, 2 and 2 spheres, the leaves medial balls, with cuts.
SphereTree validTree(const BoolGrid& object)
{
    SphereTree tree = describedTree(object);
    add(tree.spheres, tree, {5, 2, 2}, 16, -1);             // 0
    add(tree.spheres, tree, {2, 2, 1.9375}, 1.12890625, 0); // 1: (1.0625)^2
    add(tree.spheres, tree, {9, 2, 2}, 0, 0);               // 2
    add(tree.spheres, tree, {2, 2, 2}, 1, 1);               // 3
    add(tree.spheres, tree, {9, 2, 2}, 0, 2);               // 4
    tree.ijk = {Coord(5, 2, 2), Coord(2, 2, 2), Coord(9, 2, 2), Coord(2, 2, 2), Coord(9, 2, 2)};
    tree.radiusSq = {-1, -1, -1, 2, 1};
    tree.levels.resize(3);
    const int32_t begins[] = {3, 1, 0};
    for (int k = 0; k < 3; ++k) {
        tree.levels[k].level = k;
        tree.levels[k].begin = begins[k];
        tree.levels[k].end = k == 0 ? 5 : tree.levels[k - 1].begin;
    }
    tree.levels[0].pyramidVoxels = 8;
    tree.levels[0].topology = LevelTopology{2, 0, 0};
    addCuts(tree);
    computeLevelErrors(tree, object);
    return tree;
}

/// What the check says after the change, of errors recorded as they then are.
std::string after(const Change& change)
{
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree tree = validTree(*object);
    change(tree);
    computeLevelErrors(tree, *object);
    return sentencesOf(checkSphereTree(tree, *object));
}

void expectSaid(const std::string& sentence, const Change& change)
{
    const std::string said = after(change);
    EXPECT_NE(("\n" + said).find("\n" + sentence + "\n"), std::string::npos)
        << "expected: " << sentence << "\nbut it said:\n"
        << said;
}

void makeLeavesNoBalls(SphereTree& tree)
{
    tree.radiusSq = {-1, -1, -1, -1, -1};
    tree.levels[0].pyramidVoxels = 0;
    tree.levels[0].topology.reset();
}

TEST(TightCheck, FindsNothingWrongWithValidTrees)
{
    EXPECT_EQ(after([](SphereTree&) {}), "");
    EXPECT_EQ(after([](SphereTree& tree) { tree.settings.tight().cover = Cover::Balls; }), "");
}

TEST(TightCheck, TheTopLevelMayHaveManyNodes)
{
    EXPECT_EQ(after([](SphereTree& tree) {
        for (auto* values : {&tree.spheres.parent, &tree.radiusSq}) values->erase(values->begin());
        tree.spheres.center.erase(tree.spheres.center.begin());
        tree.spheres.radius.erase(tree.spheres.radius.begin());
        tree.spheres.coverRadiusSq.erase(tree.spheres.coverRadiusSq.begin());
        tree.spheres.radiusWorld.erase(tree.spheres.radiusWorld.begin());
        tree.ijk.erase(tree.ijk.begin());
        tree.spheres.parent = {-1, -1, 0, 1};
        tree.levels.pop_back();
        for (SphereTreeLevel& level : tree.levels) --level.begin, --level.end;
    }),
        "");
}

TEST(TightCheck, Level0NeedNotBeMadeOfDigitalBalls)
{
    EXPECT_EQ(after(makeLeavesNoBalls), "");
    EXPECT_EQ(after([](SphereTree& tree) {
        makeLeavesNoBalls(tree);
        tree.spheres.center[3] = {2.0625, 2, 2};
        tree.spheres.coverRadiusSq[3] = 17 * 17;
        tree.spheres.radius[3] = 17 / 16.0;
        tree.spheres.radiusWorld[3] = 2;
    }),
        "");
}

TEST(TightCheck, SaysWhenASphereThatIsNoBallClaimsWhatABallHas)
{
    expectSaid("level 1 records 7 pyramid voxels, but its spheres are no digital balls",
        [](SphereTree& tree) { tree.levels[1].pyramidVoxels = 7; });
    expectSaid("level 2 records the topology of its voxels, but its spheres are no digital balls",
        [](SphereTree& tree) { tree.levels[2].topology = LevelTopology(); });
    expectSaid("level 1: ijk is not the voxel nearest to the centre for 1 node (first: id 2)",
        [](SphereTree& tree) { tree.ijk[2] = Coord(9, 3, 2); });
    expectSaid("radius_sq is less than 1 for 3 nodes (first: id 0)",
        [](SphereTree& tree) { setType(tree.settings, TreeType::Extended); });
    expectSaid("radius_sq is less than 1 for 1 node (first: id 3)",
        [](SphereTree& tree) { tree.radiusSq[3] = -2; });
}

TEST(TightCheck, SaysWhenDigitalBallsAreNotTheObject)
{
    expectSaid(
        "level 0 does not rebuild the object: its digital balls lack 1 voxel (first: [9, 2, 2])",
        [](SphereTree& tree) { tree.ijk[4] = Coord(2, 2, 2); });
    expectSaid("level 0 records 7 pyramid voxels, but its digital balls rebuild 8",
        [](SphereTree& tree) { tree.levels[0].pyramidVoxels = 7; });
}

/// Every level covers the object, but below another node.
TEST(TightCheck, SaysWhenChainsAreBrokenThoughLevelsCover)
{
    const auto swapped = [](SphereTree& tree) {
        std::swap(tree.spheres.parent[3], tree.spheres.parent[4]);
    };
    EXPECT_EQ(after(swapped),
        "level 1 breaks the chain of spheres of 8 voxels (first: [1, 2, 2]) of the object, in the "
        "exact radii\n"
        "level 1 breaks the chain of spheres of 8 voxels (first: [1, 2, 2]) of the object, in the "
        "stored radii less their padding\n");
}

TEST(TightCheck, SaysWhenALevelMissesVoxels)
{
    const Change smaller = [](SphereTree& tree) {
        tree.spheres.coverRadiusSq[0] = 4095;
        tree.spheres.radius[0] = std::sqrt(4095.0) / 16;
    };
    expectSaid("level 2 breaks the chain of spheres of 2 voxels (first: [1, 2, 2]) of the object, "
               "in the exact radii",
        smaller);
    expectSaid(
        "level 2 misses 2 voxels (first: [1, 2, 2]) of the object, in the exact radii", smaller);
    EXPECT_EQ(after(smaller).find("stored"), std::string::npos) << "that radius is as it was";
    const Change storedSmaller = [](SphereTree& tree) {
        tree.spheres.radiusWorld[1] = std::nextafter(tree.spheres.radiusWorld[1], 0.f) - 0.01f;
    };
    expectSaid("the stored radius is less than radius and padding for 1 node (first: id 1)",
        storedSmaller);
    expectSaid("level 1 breaks the chain of spheres of 1 voxel (first: [2, 2, 3]) of the object, "
               "in the stored radii less their padding",
        storedSmaller);
}

TEST(TightCheck, SaysWhenAnInnerNodeHasNoChild)
{
    expectSaid("level 1: no child for 1 node (first: id 2)",
        [](SphereTree& tree) { tree.spheres.parent[4] = 1; });
}

TEST(TightCheck, SaysWhenASphereDoesNotContainItsLeavesWhereThatIsAsked)
{
    const Change wider = [](SphereTree& tree) {
        tree.settings.tight().cover = Cover::Balls;
        tree.spheres.radiusWorld[1] += 0.01f;
        tree.spheres.radiusWorld[0] += 0.01f;
    };
    EXPECT_EQ(after(wider), "");
    expectSaid(
        "the stored sphere does not contain every leaf ball below it for 2 nodes (first: id 0)",
        [&](SphereTree& tree) {
            wider(tree);
            tree.spheres.radiusWorld[3] += 0.02f;
        });
}

TEST(TightCheck, ParentsOutOfOrderAreReportedAndNotFollowed)
{
    expectSaid("level 0: the parent is not on the next level up for 1 node (first: id 3)",
        [](SphereTree& tree) { tree.spheres.parent[3] = 0; });
    EXPECT_EQ(after([](SphereTree& tree) { tree.spheres.parent[3] = 7; }).find("chain"),
        std::string::npos);
}

TEST(TightCheck, SaysWhenCutsAreOutOfOrder)
{
    expectSaid("the tree lacks the cuts it was made with",
        [](SphereTree& tree) { tree.cuts = SphereCuts(); });
    expectSaid("in the cuts, the arrays differ in length",
        [](SphereTree& tree) { tree.cuts.first.pop_back(); });
    expectSaid("in the cuts, node 0 has the parent 0, but a parent must be a node that comes after "
               "its children, or -1",
        [](SphereTree& tree) { tree.cuts.spheres.parent[0] = 0; });
    expectSaid("in the cuts, the cut of 1 spheres has 2", [](SphereTree& tree) {
        tree.cuts.spheres.parent[1] = -1;
        tree.cuts.first[1] = 1;
    });
    expectSaid("in the cuts, node 2 has no child",
        [](SphereTree& tree) { tree.cuts.spheres.parent[0] = tree.cuts.spheres.parent[1] = -1; });
    expectSaid("in the cuts, the centre is not a multiple of 1/16 of a voxel in range for 1 node "
               "(first: id 1)",
        [](SphereTree& tree) { tree.cuts.spheres.center[1][0] += 1 / 32.0; });
    expectSaid("in the cuts, the radius is negative or not a number for 1 node (first: id 1)",
        [](SphereTree& tree) { tree.cuts.spheres.radius[1] = -1; });
    expectSaid("in the cuts, radius and cover_sq are not the same sphere for 1 node (first: id 2)",
        [](SphereTree& tree) { tree.cuts.spheres.radius[2] = 3.9; });
    expectSaid("in the cuts, the stored radius is less than radius and padding for 1 node "
               "(first: id 2)",
        [](SphereTree& tree) { tree.cuts.spheres.radiusWorld[2] = 2; });
}

TEST(TightCheck, SaysWhenACutBreaksChains)
{
    expectSaid("the cut of 2 spheres breaks the chain of spheres of 6 voxels (first: [1, 2, 2]) of "
               "the object, in the exact radii",
        [](SphereTree& tree) { tree.cuts.spheres.coverRadiusSq[0] = 255; });
    expectSaid("the cut of 1 spheres breaks the chain of spheres of 2 voxels (first: [1, 2, 2]) of "
               "the object, in the exact radii",
        [](SphereTree& tree) { tree.cuts.spheres.coverRadiusSq[2] = 4095; });
    expectSaid("the cut of 1 spheres breaks the chain of spheres of 8 voxels (first: [1, 2, 2]) of "
               "the object, in the stored radii less their padding",
        [](SphereTree& tree) { tree.cuts.spheres.radiusWorld[2] = 0.5f; });
}

TEST(TightCheck, BrokenChainsOfLevelsAndCutsAreOfTheirKind)
{
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree tree = validTree(*object);
    std::swap(tree.spheres.parent[3], tree.spheres.parent[4]);
    tree.cuts.spheres.coverRadiusSq[0] = 255;
    const std::vector<TreeFault> faults = checkSphereTree(tree, *object);
    EXPECT_GE(faults.size(), 3u);
    for (const TreeFault& fault : faults) {
        EXPECT_EQ(toString(fault.kind), "chains") << fault.sentence;
    }
}

/// A node that ends owing nothing: its voxels have chains elsewhere.
TEST(TightCheck, ANodeThatEndsOwingNothingBreaksNoChain)
{
    const Change idle = [](SphereTree& tree) {
        SphereCuts& cuts = tree.cuts;
        cuts = SphereCuts();
        add(cuts.spheres, tree, {2, 2, 2}, 1, 3);
        add(cuts.spheres, tree, {9, 2, 2}, 0, 3);
        add(cuts.spheres, tree, {2, 3, 2}, 0, -1);
        add(cuts.spheres, tree, {5, 2, 2}, 16, -1);
        cuts.first = {2, 2, 3, 1};
        cuts.last = {3, 3, 3, 1};
    };
    EXPECT_EQ(after(idle), "");
    expectSaid(
        "the cut of 2 spheres breaks the chain of spheres of 1 voxel (first: [2, 3, 2]) of the "
        "object, in the exact radii",
        [&](SphereTree& tree) {
            idle(tree);
            tree.cuts.spheres.center[0] = {2, 1.9375, 2};
            tree.cuts.spheres.coverRadiusSq[0] = 258; // the voxel (2, 3, 2) is 17 units away
            tree.cuts.spheres.radius[0] = std::sqrt(258.0) / 16;
            tree.cuts.spheres.radiusWorld[0] = 2;
        });
}

/// One sphere inside the plus on each level; the dot and the arms are not covered.
SphereTree innerTree(const BoolGrid& object)
{
    SphereTree tree = describedTree(object);
    tree.settings.kind = InnerOptions();
    tree.settings.padding = 0;
    add(tree.spheres, tree, {2, 2, 2}, 0.5, -1);
    add(tree.spheres, tree, {2, 2.0625, 2}, 1, 0);
    for (int32_t id : {0, 1}) { // rounded down
        tree.spheres.radiusWorld[id] =
            std::nextafter(float(tree.spheres.radius[id] * tree.voxelSize()), 0.f);
    }
    tree.ijk = {Coord(2, 2, 2), Coord(2, 2, 2)};
    tree.radiusSq = {-1, -1};
    tree.levels.resize(2);
    tree.levels[1].level = 1;
    tree.levels[1].end = tree.levels[0].begin = 1;
    tree.levels[0].end = 2;
    computeLevelErrors(tree, object);
    return tree;
}

TEST(TightCheck, InnerSpheresNeedNotCoverButMustLieInside)
{
    const BoolGrid::Ptr object = plusAndDot();
    const SphereTree sound = innerTree(*object);
    EXPECT_GT(sound.levels[0].error->missing, 0);
    EXPECT_EQ(sentencesOf(checkSphereTree(sound, *object)), "");
    const auto said = [&](int64_t coverSq, const Coord& at, int32_t id) {
        SphereTree tree = sound;
        tree.spheres.center[id] = at.asVec3d();
        tree.ijk[id] = at;
        tree.spheres.coverRadiusSq[id] = coverSq;
        tree.spheres.radius[id] = std::sqrt(double(coverSq)) / 16;
        tree.spheres.radiusWorld[id] = 0;
        computeLevelErrors(tree, *object);
        return sentencesOf(checkSphereTree(tree, *object));
    };
    EXPECT_EQ(said(511, Coord(2, 2, 2), 1), "");
    EXPECT_EQ(said(512, Coord(2, 2, 2), 1),
        "level 0 holds 12 voxels (first: [1, 1, 2]) that the object has not, but its spheres lie "
        "inside\n");
    EXPECT_EQ(said(0, Coord(5, 2, 2), 0),
        "level 1 holds 1 voxel (first: [5, 2, 2]) that the object has not, but its spheres lie "
        "inside\n");
    EXPECT_EQ(said(0, Coord(9, 4, 2), 0),
        "level 1: the sphere reaches out of the object's box for 1 node (first: id 0)\n");
    EXPECT_EQ(said(int64_t(1) << 60, Coord(2, 2, 2), 1),
        "level 0: the sphere reaches out of the object's box for 1 node (first: id 1)\n");
    SphereTree tree = sound;
    tree.spheres.coverRadiusSq[1] = 512;
    tree.spheres.radius[1] = std::sqrt(512.0) / 16;
    EXPECT_EQ(toString(checkSphereTree(tree, *object).at(0).kind), "inside");
}

TEST(TightCheck, InnerRadiiAreStoredRoundedDown)
{
    const BoolGrid::Ptr object = plusAndDot();
    object->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
    SphereTree tree = innerTree(*object);
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "");
    tree.spheres.radiusWorld[1] = std::nextafter(0.1f, 1.f);
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)),
        "the stored radius is more than that inside the object for 1 node (first: id 1)\n");
}

/// Levels of balls that are each of the level below as well, in the object's own grid.
TEST(TightCheck, InnerLevelsOfDigitalBallsRecordWhatTheyCover)
{
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree tree = innerTree(*object);
    tree.spheres.center[1] = tree.spheres.center[0];
    tree.spheres.coverRadiusSq[0] = tree.spheres.coverRadiusSq[1] = 256;
    tree.spheres.radius[0] = tree.spheres.radius[1] = 1;
    tree.radiusSq = {2, 2};
    for (SphereTreeLevel& level : tree.levels) level.pyramidVoxels = 7;
    computeLevelErrors(tree, *object);
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "");
    tree.levels[1].pyramidVoxels = 8;
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)),
        "level 1 records 8 pyramid voxels, but its digital balls rebuild 7\n");
}

TEST(TightCheck, InnerCutsMustLieInside)
{
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree tree = innerTree(*object);
    tree.hasCuts = true;
    add(tree.cuts.spheres, tree, {2, 2, 2}, 1, -1);
    tree.cuts.spheres.radiusWorld[0] = 0.5f;
    tree.cuts.first = tree.cuts.last = {1};
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "");

    tree.cuts.spheres.center[0] = {3, 2, 2};
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)),
        "the list of cuts holds 5 voxels (first: [3, 1, 2]) that the object has not, but its "
        "spheres lie inside\n");
    tree.cuts.spheres.center[0] = {3, 1, 2};
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)),
        "the list of cuts: the sphere reaches out of the object's box for 1 node (first: id 0)\n");
}

/// Flat trees draw only in their plane, and their chains are there.
TEST(TightCheck, InTwoDimensionsOnlyThePlaneIsLookedAt)
{
    const BoolGrid::Ptr object = gridOf(voxelsOfBox(CoordBBox(Coord(0, 0, 7), Coord(9, 9, 7))));
    SphereTree tree = describedTree(*object);
    tree.settings.dim = 2;
    add(tree.spheres, tree, {4.5, 4.5, 7}, 40.5, -1);
    tree.ijk = {Coord(4, 5, 7)};
    tree.radiusSq = {-1};
    tree.levels.resize(1);
    tree.levels[0].end = 1;
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "");
    tree.settings.kind = InnerOptions();
    tree.spheres.coverRadiusSq[0] = 16 * 16 * 16;
    tree.spheres.radius[0] = tree.spheres.radiusWorld[0] = 4;
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "");
}

} // namespace
