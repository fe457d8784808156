// SPDX-License-Identifier: Apache-2.0
/// @file TestTreeCheck.cc
/// @brief Each invariant is broken once in a small valid tree, and the check must say so.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/TreeCheck.h>

#include "support/TreeSettings.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/measure/LevelErrors.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

namespace {

using namespace openvdb_spheretree;
using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;
using spheretree_test::setType;

class TreeCheck : public ::testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }
};

float up(double x)
{
    const float rounded = float(x);
    return double(rounded) < x ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
                               : rounded;
}

/// A plus of seven voxels around (2, 2, 2), and the voxel (9, 2, 2). Voxels of 1/2.
BoolGrid::Ptr plusAndDot()
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->setName("plus");
    object->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    const Coord offsets[] = {Coord(0, 0, 0), Coord(1, 0, 0), Coord(-1, 0, 0), Coord(0, 1, 0),
        Coord(0, -1, 0), Coord(0, 0, 1), Coord(0, 0, -1)};
    for (const Coord& offset : offsets) object->tree().setValueOn(Coord(2, 2, 2) + offset);
    object->tree().setValueOn(Coord(9, 2, 2));
    return object;
}

/// Nodes are added from the top level down.
void addNode(SphereTree& tree, const openvdb::Vec3d& center, int64_t coverSq, int32_t parent)
{
    tree.spheres.center.push_back(center);
    tree.spheres.coverRadiusSq.push_back(coverSq);
    tree.spheres.radius.push_back(std::sqrt(double(coverSq)) / 2);
    tree.spheres.parent.push_back(parent);
    const double padded = tree.spheres.radius.back() + tree.settings.paddingVoxels();
    tree.spheres.radiusWorld.push_back(up(padded * tree.voxelSize() * (1 + 1e-6)));
}

/// A valid extended tree of plusAndDot(), written down by hand: three levels of 2, 2 and 1 nodes.
SphereTree validTree(const BoolGrid& object, TreeType type = TreeType::Extended)
{
    SphereTree tree;
    setType(tree.settings, type);
    tree.settings.padding = 0;
    tree.transform = object.transform().copy();
    tree.object = {"plus", 8, 2, 0, CoordBBox(Coord(1, 1, 1), Coord(9, 3, 3))};
    // The root must contain the ball of radius 1 around (2, 2, 2) and the point (9, 2, 2).
    addNode(tree, {5.5, 2, 2}, 81, -1);    // 0: radius 4.5
    addNode(tree, {2.5, 2.5, 2.5}, 14, 0); // 1: radius 1.87 > 0.87 + 1
    addNode(tree, {8.5, 2.5, 2.5}, 3, 0);  // 2: radius 0.87
    addNode(tree, {2, 2, 2}, 4, 1);        // 3: radius 1
    addNode(tree, {9, 2, 2}, 0, 2);        // 4: a voxel
    tree.ijk = {Coord(1, 0, 0), Coord(1, 1, 1), Coord(4, 1, 1), Coord(2, 2, 2), Coord(9, 2, 2)};
    tree.radiusSq = {1, 1, 1, 2, 1};
    tree.levels.resize(3);
    const int32_t begins[] = {3, 1, 0, 5};
    const int64_t voxels[] = {8, 2, 1};
    for (int k = 0; k < 3; ++k) {
        tree.levels[k].level = k;
        tree.levels[k].begin = begins[k];
        tree.levels[k].end = k == 0 ? 5 : begins[k - 1];
        tree.levels[k].pyramidVoxels = voxels[k];
    }
    tree.levels[0].topology = LevelTopology{2, 0, 0};
    tree.dag = {{0, 1}, {0, 2}, {1, 3}, {2, 4}};
    computeLevelErrors(tree, object);
    return tree;
}

SphereTree oneLevel(const SphereTree& tree, int k)
{
    SphereTree result = tree;
    const SphereTreeLevel level = tree.levels[k];
    const auto cut = [&](auto& all) { all = {all.begin() + level.begin, all.begin() + level.end}; };
    result.spheres = tree.spheres.slice(level.begin, level.end);
    cut(result.ijk);
    cut(result.radiusSq);
    result.spheres.parent.assign(result.ijk.size(), -1);
    result.dag.clear();
    result.levels = {level};
    result.levels[0].begin = 0;
    result.levels[0].end = result.size();
    return result;
}

std::string joined(const std::vector<TreeFault>& faults)
{
    std::string text;
    for (const TreeFault& fault : faults) text += fault.sentence + "\n";
    return text;
}

/// Damages a valid tree; the check must report exactly this (other things may follow from it).
void expectFault(FaultKind kind, const std::function<void(SphereTree&)>& damage,
    const std::string& sentence, TreeType type = TreeType::Extended)
{
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree tree = validTree(*object, type);
    damage(tree);
    const std::vector<TreeFault> faults = checkSphereTree(tree, *object);
    const auto found = std::find_if(faults.begin(), faults.end(),
        [&](const TreeFault& fault) { return fault.sentence == sentence; });
    ASSERT_NE(found, faults.end()) << "expected: " << sentence << "\nbut it said:\n"
                                   << joined(faults);
    EXPECT_EQ(toString(found->kind), toString(kind)) << sentence;
}

TEST_F(TreeCheck, FindsNothingWrongWithAValidTree)
{
    const BoolGrid::Ptr object = plusAndDot();
    for (TreeType type : {TreeType::Extended, TreeType::Reversible}) {
        const SphereTree tree = validTree(*object, type);
        EXPECT_EQ(joined(checkSphereTree(tree, *object)), "");
        for (int level = 0; level < 3; ++level) {
            EXPECT_EQ(joined(checkSphereTree(oneLevel(tree, level), *object)), "") << level;
        }
    }
}

/// The same spheres, and a finer unit than they need.
TEST_F(TreeCheck, FindsNothingWrongWithAValidTreeInSixteenths)
{
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree tree = validTree(*object);
    tree.subdivision = 16;
    for (int64_t& square : tree.spheres.coverRadiusSq) square *= 64;
    EXPECT_EQ(joined(checkSphereTree(tree, *object)), "");
    tree.spheres.center[3][0] += 1.0 / 32;
    const std::string failures = joined(checkSphereTree(tree, *object));
    EXPECT_EQ(failures,
        "the centre is not a multiple of 1/16 of a voxel in range for 1 node (first: id 3)\n");
}

TEST_F(TreeCheck, FindsNothingWrongWithPaddedRadiiWhateverTheVoxelSize)
{
    for (double voxel : {1.0, 0.1, 1.0 / 3, 12345.678, 1e-3}) {
        const BoolGrid::Ptr object = plusAndDot();
        object->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
        for (double padding : {SphereTreeSettings::kPadCubes, 0.0, 0.3}) {
            SphereTree tree = oneLevel(validTree(*object), 0);
            tree.settings.padding = padding;
            for (int id = 0; id < tree.size(); ++id) {
                tree.spheres.radiusWorld[id] =
                    up((tree.spheres.radius[id] + tree.settings.paddingVoxels()) * voxel);
            }
            EXPECT_EQ(joined(checkSphereTree(tree, *object)), "") << voxel << ' ' << padding;
        }
    }
}

TEST_F(TreeCheck, InTwoDimensionsOnlyThePlaneIsLookedAt)
{
    BoolGrid::Ptr object = BoolGrid::create();
    for (const Coord& q :
        {Coord(2, 2, 5), Coord(1, 2, 5), Coord(3, 2, 5), Coord(2, 1, 5), Coord(2, 3, 5)}) {
        object->tree().setValueOn(q);
    }
    SphereTree tree;
    setType(tree.settings, TreeType::Extended);
    tree.settings.dim = 2;
    tree.settings.padding = 0;
    tree.transform = object->transform().copy();
    tree.object = {"", 5, 1, 0, CoordBBox(Coord(1, 1, 5), Coord(3, 3, 5))};
    addNode(tree, {2, 2, 5}, 4, -1);
    tree.ijk = {Coord(2, 2, 5)};
    tree.radiusSq = {2};
    tree.levels.resize(1);
    tree.levels[0].end = 1;
    tree.levels[0].pyramidVoxels = 5;
    EXPECT_EQ(joined(checkSphereTree(tree, *object)), "");
    tree.radiusSq = {3}; // corners, in the plane
    EXPECT_NE(joined(checkSphereTree(tree, *object)), "");
}

TEST_F(TreeCheck, FindsNothingWrongWithADiscInTwoDimensions)
{
    BoolGrid::Ptr object = BoolGrid::create();
    const CoordBBox square(Coord(-20, -20, 5), Coord(20, 20, 5));
    for (auto q = square.begin(); q; ++q) {
        if ((*q)[0] * (*q)[0] + (*q)[1] * (*q)[1] <= 400) object->tree().setValueOn(*q);
    }
    for (TreeType type : {TreeType::Extended, TreeType::Reversible}) {
        SphereTreeSettings settings;
        settings.dim = 2;
        setType(settings, type);
        EXPECT_EQ(joined(checkSphereTree(buildSphereTree(*object, settings), *object)), "");
    }
}

TEST_F(TreeCheck, KindsOfFaultsHaveNamesOfTheirOwn)
{
    EXPECT_EQ(toString(FaultKind::Shape), "shape");
    EXPECT_EQ(toString(FaultKind::LeafBalls), "leaf balls");
    EXPECT_EQ(toString(FaultKind::Chains), "chains");
    EXPECT_EQ(toString(FaultKind::Inside), "inside");
    EXPECT_EQ(toString(FaultKind::Errors), "errors") << "the last one";
    std::set<std::string> names;
    const int count = int(FaultKind::Errors) + 1;
    for (int kind = 0; kind < count; ++kind) names.insert(toString(FaultKind(kind)));
    EXPECT_EQ(int(names.size()), count);
}

TEST_F(TreeCheck, SaysWhenArraysDifferInLength)
{
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.spheres.parent.pop_back(); },
        "the tree has 5 centres, but 4 entries in parent");
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.radiusSq.push_back(1); },
        "the tree has 5 centres, but 6 entries in radiusSq");
}

TEST_F(TreeCheck, SaysWhenLevelsAreNoRangesOfNodes)
{
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.subdivision = 3; },
        "centres are in units of 1/3 of a voxel, not 1/2 or 1/16");
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.levels[1].begin = 2; },
        "level 1 is nodes 2 to 3 (exclusive), where nodes from 1 on are expected");
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.levels[0].end = 4; },
        "the levels have 4 nodes, but the tree has 5");
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.levels[0].end = 7; },
        "level 0 is nodes 3 to 7 (exclusive), where nodes from 3 on are expected");
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.levels[1].level = 4; },
        "level 4 stands where level 1 belongs");
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.levels[1].end = tree.levels[0].begin = 1; },
        "level 1 is nodes 1 to 1 (exclusive), where nodes from 1 on are expected");
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.levels.clear(); }, "the tree has no levels");
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.transform.reset(); },
        "the tree has no transform");
}

TEST_F(TreeCheck, SaysWhenTheNumberOfALevelThatStandsAloneIsNegative)
{
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree tree = oneLevel(validTree(*object), 1);
    tree.levels[0].level = -1;
    EXPECT_EQ(joined(checkSphereTree(tree, *object)), "level -1 stands where level 0 belongs\n");
}

TEST_F(TreeCheck, SaysWhenNumbersAreOutOfRange)
{
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    for (double far : {infinity, -infinity, 1e10}) {
        expectFault(
            FaultKind::Shape, [&](SphereTree& tree) { tree.spheres.center[2].z() = far; },
            "the centre is not a multiple of 1/2 of a voxel in range for 1 node (first: id 2)");
    }
    expectFault(
        FaultKind::Shape, [&](SphereTree& tree) { tree.spheres.center[3].y() = nan; },
        "the centre is not a multiple of 1/2 of a voxel in range for 1 node (first: id 3)");
    expectFault(
        FaultKind::Shape,
        [](SphereTree& tree) { tree.spheres.center[1].x() = tree.spheres.center[2].x() = 0.25; },
        "the centre is not a multiple of 1/2 of a voxel in range for 2 nodes (first: id 1)");
    expectFault(
        FaultKind::Shape, [&](SphereTree& tree) { tree.spheres.radius[4] = nan; },
        "the radius is negative or not a number for 1 node (first: id 4)");
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.spheres.coverRadiusSq[0] = -1; },
        "the radius is negative or not a number for 1 node (first: id 0)");
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.spheres.radius[4] = -1; },
        "the radius is negative or not a number for 1 node (first: id 4)");
    for (double bad : {nan, infinity, -0.5}) {
        expectFault(
            FaultKind::Shape, [&](SphereTree& tree) { tree.spheres.radiusWorld[0] = float(bad); },
            "the stored radius is negative or not a number for 1 node (first: id 0)");
    }
    expectFault(
        FaultKind::Shape, [](SphereTree& tree) { tree.radiusSq[2] = 0; },
        "radius_sq is less than 1 for 1 node (first: id 2)");
}

TEST_F(TreeCheck, SaysWhenWhatIsRecordedOfTheObjectIsWrong)
{
    expectFault(
        FaultKind::Counts, [](SphereTree& tree) { tree.object.voxels = 9; },
        "the tree records 9 voxels of the object, which has 8");
    expectFault(
        FaultKind::Counts, [](SphereTree& tree) { tree.object.leaves = 1; },
        "the tree records 1 leaves of the object, which has 2");
    expectFault(
        FaultKind::Counts, [](SphereTree& tree) { tree.object.tiles = 1; },
        "the tree records 1 tiles of the object, which has 0");
    expectFault(
        FaultKind::Counts, [](SphereTree& tree) { tree.object.bbox.max().x() = 10; },
        "the tree records [1, 1, 1] -> [10, 3, 3] as the object's box, which is "
        "[1, 1, 1] -> [9, 3, 3]");
}

TEST_F(TreeCheck, SaysWhenARecordedErrorIsWrong)
{
    const BoolGrid::Ptr object = plusAndDot();
    const LevelError error = *validTree(*object).levels[1].error;
    const std::string excess = std::to_string(error.excess);
    expectFault(
        FaultKind::Errors, [](SphereTree& tree) { tree.levels[1].error->excess = 3; },
        "level 1 records 3 voxels of excess, but it is " + excess);
    expectFault(
        FaultKind::Errors, [](SphereTree& tree) { tree.levels[0].error->covered = 7; },
        "level 0 records 7 voxels covered, but it is 8");
    expectFault(
        FaultKind::Errors, [](SphereTree& tree) { tree.levels[2].error->missing = 1; },
        "level 2 records 1 voxels missing, but it is 0");
    expectFault(
        FaultKind::Errors, [](SphereTree& tree) { tree.levels[0].error->hammingPercent = 12.5; },
        "level 0 records 12.5 % Hamming error, but it is 0");
    expectFault(
        FaultKind::Errors, [](SphereTree& tree) { tree.levels[0].error->hausdorff = 1; },
        "level 0 records 1 voxels of Hausdorff distance, but it is 0");
}

TEST_F(TreeCheck, SaysWhenARecordedTopologyIsNotTheObjects)
{
    expectFault(
        FaultKind::Topology,
        [](SphereTree& tree) {
            tree.levels[0].topology = LevelTopology{1, 0, 0};
        },
        "level 0 records 1 components of the object, which has 2");
    expectFault(
        FaultKind::Topology,
        [](SphereTree& tree) {
            tree.levels[0].topology = LevelTopology{2, 4, 0};
        },
        "level 0 records 4 tunnels of the object, which has 0");
    expectFault(
        FaultKind::Topology,
        [](SphereTree& tree) {
            tree.levels[0].topology = LevelTopology{2, 0, 5};
        },
        "level 0 records 5 cavities of the object, which has 0");
}

TEST_F(TreeCheck, SaysWhenTheRadiiOfANodeDisagree)
{
    expectFault(
        FaultKind::Radii, [](SphereTree& tree) { tree.spheres.radius[3] = 0.9; },
        "radius and cover_sq are not the same sphere for 1 node (first: id 3)");
    expectFault(
        FaultKind::Radii, [](SphereTree& tree) { tree.spheres.coverRadiusSq[1] = 2; },
        "radius and cover_sq are not the same sphere for 1 node (first: id 1)");
    expectFault(
        FaultKind::Radii, [](SphereTree& tree) { tree.settings.padding = 0.125; },
        "the stored radius is less than radius and padding for 5 nodes (first: id 0)");
}

TEST_F(TreeCheck, SaysWhenAParentIsNotOnTheNextLevelUp)
{
    expectFault(
        FaultKind::Links, [](SphereTree& tree) { tree.spheres.parent[3] = 0; },
        "level 0: the parent is not on the next level up for 1 node (first: id 3)");
    expectFault(
        FaultKind::Links,
        [](SphereTree& tree) { tree.spheres.parent[1] = tree.spheres.parent[2] = 3; },
        "level 1: the parent is not on the next level up for 2 nodes (first: id 1)");
    expectFault(
        FaultKind::Links, [](SphereTree& tree) { tree.spheres.parent[4] = -1; },
        "level 0: the parent is not on the next level up for 1 node (first: id 4)");
    expectFault(
        FaultKind::Links, [](SphereTree& tree) { tree.spheres.parent[0] = 0; },
        "level 2: the parent is not -1, though this is the top level, for 1 node (first: id 0)");
    expectFault(
        FaultKind::Links,
        [](SphereTree& tree) { tree.spheres.parent[3] = 3; }, // the first of its own level
        "level 0: the parent is not on the next level up for 1 node (first: id 3)");
    expectFault(
        FaultKind::Links, [](SphereTree& tree) { tree.spheres.parent[3] = 1000000; },
        "level 0: the parent is not on the next level up for 1 node (first: id 3)");
}

TEST_F(TreeCheck, SaysWhenThereIsMoreThanOneRoot)
{
    const BoolGrid::Ptr object = plusAndDot();
    const SphereTree whole = validTree(*object);
    SphereTree tree = whole;
    const auto behead = [](auto& all) { all.erase(all.begin()); };
    behead(tree.spheres.center);
    behead(tree.spheres.radius);
    behead(tree.spheres.coverRadiusSq);
    behead(tree.spheres.radiusWorld);
    behead(tree.ijk);
    behead(tree.radiusSq);
    tree.spheres.parent = {-1, -1, 0, 1};
    tree.dag = {{0, 2}, {1, 3}};
    tree.levels.pop_back();
    for (SphereTreeLevel& level : tree.levels) {
        --level.begin;
        --level.end;
    }
    EXPECT_EQ(joined(checkSphereTree(tree, *object)),
        "level 1, the top one, has 2 nodes instead of one root\n");
}

TEST_F(TreeCheck, SaysWhenDagEdgesAreWrong)
{
    expectFault(
        FaultKind::Edges,
        [](SphereTree& tree) {
            tree.dag[3] = {2, 2};
        },
        "1 edges of the DAG do not lead to the next level down (first: 2 to 2)");
    expectFault(
        FaultKind::Edges,
        [](SphereTree& tree) {
            tree.dag[0] = {0, 5};
        },
        "1 edges of the DAG do not lead to the next level down (first: 0 to 5)");
    expectFault(
        FaultKind::Edges,
        [](SphereTree& tree) {
            tree.dag[1] = {0, 3};
        },
        "1 edges of the DAG do not lead to the next level down (first: 0 to 3)");
    expectFault(
        FaultKind::Edges, [](SphereTree& tree) { tree.dag[1] = tree.dag[0]; },
        "1 edges of the DAG are out of order or repeated (first: 0 to 1)");
}

TEST_F(TreeCheck, SaysWhenAnInnerNodeOfAnExtendedTreeHasNoChild)
{
    const auto damage = [](SphereTree& tree) { tree.spheres.parent[4] = 1; };
    expectFault(FaultKind::Links, damage, "level 1: no child for 1 node (first: id 2)");
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree reversible = validTree(*object, TreeType::Reversible);
    damage(reversible); // nothing that a reversible tree promises
    EXPECT_EQ(joined(checkSphereTree(reversible, *object)), "");
}

TEST_F(TreeCheck, SaysWhenAStoredSphereDoesNotContainItsLeaves)
{
    const auto damage = [](SphereTree& tree) { tree.spheres.radiusWorld[0] *= 0.999f; };
    expectFault(FaultKind::LeafBalls, damage,
        "the stored sphere does not contain every leaf ball below it for 1 node (first: id 0)");
}

TEST_F(TreeCheck, SaysWhenLevel0DoesNotRebuildTheObject)
{
    expectFault(
        FaultKind::DigitalBalls, [](SphereTree& tree) { tree.radiusSq[3] = 1; },
        "level 0 does not rebuild the object: its digital balls lack 6 voxels "
        "(first: [1, 2, 2])");
    expectFault(
        FaultKind::DigitalBalls, [](SphereTree& tree) { tree.ijk[4].x() = 12; },
        "level 0 does not rebuild the object: its digital balls hold 1 voxel (first: [12, 2, 2]) "
        "that the object has not");
    expectFault(
        FaultKind::DigitalBalls, [](SphereTree& tree) { tree.ijk[4].x() = 12; },
        "level 0 does not rebuild the object: its digital balls lack 1 voxel (first: [9, 2, 2])");
    const auto huge = [](SphereTree& tree) { tree.radiusSq[4] = 2000000000; };
    expectFault(FaultKind::DigitalBalls, huge,
        "level 0: the digital ball is larger than the level's 8 voxels for 1 node (first: id 4)");
    expectFault(
        FaultKind::DigitalBalls, // the object counts, not what is recorded of it
        [&](SphereTree& tree) {
            huge(tree);
            tree.levels[0].pyramidVoxels = int64_t(1) << 60;
        },
        "level 0: the digital ball is larger than the level's 8 voxels for 1 node (first: id 4)");
}

TEST_F(TreeCheck, SaysWhenARecordedVolumeIsNotThatOfTheBalls)
{
    expectFault(
        FaultKind::DigitalBalls, [](SphereTree& tree) { tree.levels[0].pyramidVoxels = 7; },
        "level 0 records 7 pyramid voxels, but its digital balls rebuild 8");
    expectFault(
        FaultKind::DigitalBalls, [](SphereTree& tree) { tree.levels[0].pyramidVoxels = 9; },
        "level 0 records 9 pyramid voxels, but its digital balls rebuild 8");
    expectFault(
        FaultKind::DigitalBalls, [](SphereTree& tree) { tree.levels[1].pyramidVoxels = 1; },
        "level 1 records 1 pyramid voxels, but its digital balls rebuild 2");
    const auto more = [](SphereTree& tree) { tree.levels[1].pyramidVoxels = 3; };
    expectFault(FaultKind::DigitalBalls, more,
        "level 1 records 3 pyramid voxels, but its digital balls rebuild 2", TreeType::Reversible);
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree extended = validTree(*object);
    more(extended); // some ball may have been dropped
    EXPECT_EQ(joined(checkSphereTree(extended, *object)), "");
}

TEST_F(TreeCheck, SaysWhenALevelMissesVoxelsInTheExactRadii)
{
    const auto damage = [](SphereTree& tree) { tree.spheres.coverRadiusSq[1] = 10; };
    expectFault(FaultKind::Coverage, damage,
        "level 1 misses 3 voxels (first: [1, 2, 2]) of the object, in the exact radii");
    const auto moved = [](SphereTree& tree) { tree.spheres.center[0].x() = 6; };
    const std::string sentence = "level 2 misses 1 voxel (first: [1, 2, 2]) of the object, in the ";
    expectFault(FaultKind::Coverage, moved, sentence + "exact radii");
    expectFault(FaultKind::Coverage, moved, sentence + "stored radii less their padding");
}

TEST_F(TreeCheck, SaysWhenALevelMissesVoxelsInTheStoredRadii)
{
    // World radius 1/2 covers the plus with voxels of 1/2; the next float below does not.
    const auto damage = [](SphereTree& tree) {
        tree.spheres.radiusWorld[3] = std::nextafter(0.5f, 0.0f);
    };
    expectFault(FaultKind::Coverage, damage,
        "level 0 misses 6 voxels (first: [1, 2, 2]) of the object, in the stored "
        "radii less their padding");
    // Padding is taken off before voxel centres are looked at.
    expectFault(
        FaultKind::Coverage, [](SphereTree& tree) { tree.settings.padding = 1e-4; },
        "level 0 misses 7 voxels (first: [1, 2, 2]) of the object, in the stored radii less their "
        "padding");
}

TEST_F(TreeCheck, CoverageOfVoxelsFarApartIsCheckedWithoutDrawingWhatIsBetween)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().setValueOn(Coord(0));
    object->tree().setValueOn(Coord(1000000));
    SphereTree tree;
    setType(tree.settings, TreeType::Extended);
    tree.settings.padding = 0;
    tree.transform = object->transform().copy();
    tree.object = {"", 2, 2, 0, CoordBBox(Coord(0), Coord(1000000))};
    addNode(tree, openvdb::Vec3d(500000), int64_t(3) * 1000000 * 1000000, -1);
    tree.ijk = {Coord(0)};
    tree.radiusSq = {1};
    tree.levels.resize(1);
    tree.levels[0].level = 20;
    tree.levels[0].end = 1;
    tree.levels[0].pyramidVoxels = 1;
    EXPECT_EQ(joined(checkSphereTree(tree, *object)), "");
    --tree.spheres.coverRadiusSq[0];
    EXPECT_EQ(joined(checkSphereTree(tree, *object)),
        "level 20 misses 2 voxels (first: [0, 0, 0]) of the object, in the exact radii\n");
}

TEST_F(TreeCheck, StopsWhenInterrupted)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    const BoolGrid::Ptr object = plusAndDot();
    EXPECT_THROW(checkSphereTree(validTree(*object), *object, &stop), Interrupted);
}

TEST_F(TreeCheck, SaysWhenTheObjectLiesElsewhereInTheWorld)
{
    const BoolGrid::Ptr object = plusAndDot();
    const SphereTree tree = validTree(*object);
    const auto faultsWith = [&](const openvdb::math::Transform::Ptr& transform) {
        object->setTransform(transform);
        return checkSphereTree(tree, *object);
    };
    const auto expectPlace = [&](const openvdb::math::Transform::Ptr& transform) {
        const std::vector<TreeFault> faults = faultsWith(transform);
        ASSERT_FALSE(faults.empty());
        EXPECT_EQ(toString(faults[0].kind), "place");
        EXPECT_EQ(faults[0].sentence.rfind("the object's transform is not the tree's", 0), 0u);
    };
    auto moved = openvdb::math::Transform::createLinearTransform(0.5);
    moved->postTranslate(openvdb::Vec3d(0, 0.01, 0));
    expectPlace(moved);
    const auto larger = openvdb::math::Transform::createLinearTransform(1.5);
    expectPlace(larger);
    auto rotated = openvdb::math::Transform::createLinearTransform(0.5);
    rotated->postRotate(0.1, openvdb::math::Z_AXIS);
    expectPlace(rotated);
    auto rounded = openvdb::math::Transform::createLinearTransform(0.5);
    rounded->postTranslate(openvdb::Vec3d(0, 1e-6, 0)); // as another program may have written it
    EXPECT_EQ(joined(faultsWith(rounded)), "");
}

TEST_F(TreeCheck, TakesNoMemoryOnTheWordOfADamagedFile)
{
    expectFault(
        FaultKind::DigitalBalls,
        [](SphereTree& tree) {
            tree.radiusSq[0] = std::numeric_limits<int32_t>::max();
            tree.levels[2].pyramidVoxels = int64_t(1) << 62;
        },
        "level 2 records 4611686018427387904 pyramid voxels, more than the object's box has room "
        "for");
}

} // namespace
