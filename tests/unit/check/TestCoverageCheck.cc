// SPDX-License-Identifier: Apache-2.0
/// @file TestCoverageCheck.cc
/// @brief What spheres and digital balls cover is broken once in a small valid tree, and the check must
/// say so.

#include "support/CheckedTrees.h"
#include "support/TreeSettings.h"

#include <openvdb_spheretree/check/TreeCheck.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <limits>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;

TEST(CoverageCheck, InTwoDimensionsOnlyThePlaneIsLookedAt)
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
    tree.settings.topology = false;
    tree.transform = object->transform().copy();
    tree.object = {"", 5, 1, 0, CoordBBox(Coord(1, 1, 5), Coord(3, 3, 5))};
    addSphere(tree, {2, 2, 5}, 4, -1);
    tree.ijk = {Coord(2, 2, 5)};
    tree.radiusSq = {2};
    tree.levels.resize(1);
    tree.levels[0].end = 1;
    tree.levels[0].pyramidVoxels = 5;
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "");
    tree.radiusSq = {3}; // corners, in the plane
    EXPECT_NE(sentencesOf(checkSphereTree(tree, *object)), "");
}

TEST(CoverageCheck, SaysWhenAStoredSphereDoesNotContainItsLeaves)
{
    const auto damage = [](SphereTree& tree) { tree.spheres.radiusWorld[0] *= 0.999f; };
    expectFault(FaultKind::LeafBalls, damage,
        "the stored sphere does not contain every leaf ball below it for 1 node (first: id 0)");
}

TEST(CoverageCheck, SaysWhenLevel0DoesNotRebuildTheObject)
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
    expectFault(
        FaultKind::DigitalBalls, [](SphereTree& tree) { tree.radiusSq[4] = 16; },
        "level 0: the digital ball is larger than the level's 8 voxels for 1 node (first: id 4)");
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

TEST(CoverageCheck, SaysWhenARecordedVolumeIsNotThatOfTheBalls)
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
    SphereTree extended = plusAndDotTree(*object);
    more(extended); // some ball may have been dropped
    EXPECT_EQ(sentencesOf(checkSphereTree(extended, *object)), "");
}

TEST(CoverageCheck, SaysWhenALevelMissesVoxelsInTheExactRadii)
{
    const auto damage = [](SphereTree& tree) { tree.spheres.coverRadiusSq[1] = 10; };
    expectFault(FaultKind::Coverage, damage,
        "level 1 misses 3 voxels (first: [1, 2, 2]) of the object, in the exact radii");
    const auto moved = [](SphereTree& tree) { tree.spheres.center[0].x() = 6; };
    const std::string sentence = "level 2 misses 1 voxel (first: [1, 2, 2]) of the object, in the ";
    expectFault(FaultKind::Coverage, moved, sentence + "exact radii");
    expectFault(FaultKind::Coverage, moved, sentence + "stored radii less their padding");
}

TEST(CoverageCheck, SaysWhenALevelMissesVoxelsInTheStoredRadii)
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

TEST(CoverageCheck, CoverageOfVoxelsFarApartIsCheckedWithoutDrawingWhatIsBetween)
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->tree().setValueOn(Coord(0));
    object->tree().setValueOn(Coord(1000000));
    SphereTree tree;
    setType(tree.settings, TreeType::Extended);
    tree.settings.padding = 0;
    tree.settings.topology = false;
    tree.transform = object->transform().copy();
    tree.object = {"", 2, 2, 0, CoordBBox(Coord(0), Coord(1000000))};
    addSphere(tree, openvdb::Vec3d(500000), int64_t(3) * 1000000 * 1000000, -1);
    tree.ijk = {Coord(0)};
    tree.radiusSq = {1};
    tree.levels.resize(1);
    tree.levels[0].level = 20;
    tree.levels[0].end = 1;
    tree.levels[0].pyramidVoxels = 1;
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "");
    --tree.spheres.coverRadiusSq[0];
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)),
        "level 20 misses 2 voxels (first: [0, 0, 0]) of the object, in the exact radii\n");
}

TEST(CoverageCheck, TakesNoMemoryOnTheWordOfADamagedFile)
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
