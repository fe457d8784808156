// SPDX-License-Identifier: Apache-2.0
/// @file TestTreeCheck.cc
/// @brief Each invariant of arrays, numbers, links and records is broken once in a small valid tree, and
/// the check must say so. (What spheres cover: TestCoverageCheck.cc.)

#include "support/CheckedTrees.h"
#include "support/SampleTrees.h"
#include "support/TightSamples.h"
#include "support/TreeSettings.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/measure/LevelErrors.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <limits>
#include <set>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;

class TreeCheck : public ::testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }
};

TEST_F(TreeCheck, FindsNothingWrongWithAValidTree)
{
    const BoolGrid::Ptr object = plusAndDot();
    for (TreeType type : {TreeType::Extended, TreeType::Reversible}) {
        const SphereTree tree = plusAndDotTree(*object, type);
        EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "");
        for (int level = 0; level < 3; ++level) {
            EXPECT_EQ(sentencesOf(checkSphereTree(oneLevelOf(tree, level), *object)), "") << level;
        }
    }
}

/// The same spheres, and a finer unit than they need.
TEST_F(TreeCheck, FindsNothingWrongWithAValidTreeInSixteenths)
{
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree tree = plusAndDotTree(*object);
    tree.subdivision = 16;
    for (int64_t& square : tree.spheres.coverRadiusSq) square *= 64;
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "");
    tree.spheres.center[3][0] += 1.0 / 32;
    const std::string failures = sentencesOf(checkSphereTree(tree, *object));
    EXPECT_EQ(failures,
        "the centre is not a multiple of 1/16 of a voxel in range for 1 node (first: id 3)\n");
}

TEST_F(TreeCheck, FindsNothingWrongWithPaddedRadiiWhateverTheVoxelSize)
{
    for (double voxel : {1.0, 0.1, 1.0 / 3, 12345.678, 1e-3}) {
        const BoolGrid::Ptr object = plusAndDot();
        object->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
        for (double padding : {SphereTreeSettings::kPadCubes, 0.0, 0.3}) {
            SphereTree tree = oneLevelOf(plusAndDotTree(*object), 0);
            tree.settings.padding = padding;
            for (int id = 0; id < tree.size(); ++id) {
                tree.spheres.radiusWorld[id] =
                    floatAbove((tree.spheres.radius[id] + tree.settings.paddingVoxels()) * voxel);
            }
            computeLevelErrors(tree, *object); // those of stored spheres are others now
            EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "") << voxel << ' ' << padding;
        }
    }
}

/// As in a scan of a landscape: any angle, and far away from the world's origin.
TEST_F(TreeCheck, FindsNothingWrongWithTurnedObjectsFarAway)
{
    const BoolGrid::Ptr object = plusAndDot();
    for (const double far : {1e4, 3e4, 1e5, 1e8, 1e12}) {
        for (int turn = 1; turn < 15; ++turn) {
            openvdb::Mat4d matrix = openvdb::Mat4d::identity();
            matrix.postRotate(openvdb::math::Z_AXIS, 0.1 * turn);
            matrix.postTranslate(openvdb::Vec3d(far, 2 * far, 3 * far));
            object->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
            const SphereTreeSettings::Kind kinds[] = {
                TightOptions(), InnerOptions(), ExtendedOptions()};
            for (const SphereTreeSettings::Kind& kind : kinds) {
                SphereTreeSettings settings;
                settings.kind = kind;
                if (!settings.isInner()) settings.padding = SphereTreeSettings::kPadCubes;
                const SphereTree tree = buildSphereTree(*object, settings);
                EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "")
                    << far << ", turned by " << turn << " tenths, kind " << kind.index();
            }
        }
    }
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
        EXPECT_EQ(sentencesOf(checkSphereTree(buildSphereTree(*object, settings), *object)), "");
    }
}

TEST_F(TreeCheck, KindsOfFaultsHaveNamesOfTheirOwn)
{
    EXPECT_EQ(toString(FaultKind::Shape), "shape");
    EXPECT_EQ(toString(FaultKind::LeafBalls), "leaf balls");
    EXPECT_EQ(toString(FaultKind::Records), "records");
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
        "centres are in units of 1/3 of a voxel, not 1/2, 1/16 or 1/1024");
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
    SphereTree tree = oneLevelOf(plusAndDotTree(*object), 1);
    tree.levels[0].level = -1;
    EXPECT_EQ(
        sentencesOf(checkSphereTree(tree, *object)), "level -1 stands where level 0 belongs\n");
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

TEST_F(TreeCheck, SaysWhenARadiusOfANormIsNoSquare)
{
    expectFault(
        FaultKind::Shape,
        [](SphereTree& tree) {
            tree.settings.pyramid().dist = Distance::linf();
            std::fill(tree.radiusSq.begin(), tree.radiusSq.end(), 4);
            tree.radiusSq[2] = 5;
        },
        "radius_sq is no square, as those of a norm are, for 1 node (first: id 2)");
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
    const LevelError error = *plusAndDotTree(*object).levels[1].error;
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

TEST_F(TreeCheck, SaysWhenARecordedErrorOfStoredSpheresIsWrong)
{
    expectFault(
        FaultKind::Errors, [](SphereTree& tree) { tree.levels[1].stored->hammingPercent = 77777; },
        "level 1 records 77777 % Hamming error of stored spheres, but it is 400");
    expectFault(
        FaultKind::Errors, [](SphereTree& tree) { tree.levels[0].stored->reachWorld = 1e-3; },
        "level 0 records 0.001 as the reach of stored spheres, but it is 0.250001");
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree old = plusAndDotTree(*object);
    for (SphereTreeLevel& level : old.levels) level.stored.reset();
    EXPECT_TRUE(checkSphereTree(old, *object).empty()) << "files of version 0.1 have none";
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

TEST_F(TreeCheck, SaysWhenTheTopologyOfALevelIsNotThatOfItsVoxels)
{
    for (TreeType type : {TreeType::Extended, TreeType::Reversible}) {
        expectFault(
            FaultKind::Topology, [](SphereTree& tree) { tree.levels[1].topology->components = 1; },
            "level 1 records 1 components of its voxels, which have 2", type);
        expectFault(
            FaultKind::Topology, [](SphereTree& tree) { tree.levels[2].topology->tunnels = 3; },
            "level 2 records 3 tunnels of its voxels, which have 0", type);
    }
}

TEST_F(TreeCheck, SaysWhenATopologyIsLostOrWasNotAskedFor)
{
    for (int level : {0, 1, 2}) {
        const std::string number = std::to_string(level);
        expectFault(
            FaultKind::Records, [=](SphereTree& tree) { tree.levels[level].topology.reset(); },
            "level " + number + " records no topology, but the tree was made with topology=1");
        expectFault(
            FaultKind::Records,
            [=](SphereTree& tree) {
                const auto topology = tree.levels[level].topology;
                for (SphereTreeLevel& each : tree.levels) each.topology.reset();
                tree.settings.topology = false;
                tree.levels[level].topology = topology;
            },
            "level " + number + " records a topology, but the tree was made with topology=0");
    }
}

TEST_F(TreeCheck, SaysWhenTheErrorsOfSomeLevelsAreLost)
{
    for (int level : {0, 1, 2}) {
        expectFault(
            FaultKind::Records, [=](SphereTree& tree) { tree.levels[level].error.reset(); },
            "level " + std::to_string(level) + " records no errors, though other levels do");
    }
    expectFault(
        FaultKind::Records, [](SphereTree& tree) { tree.levels[1].errorUnknown = "too large"; },
        "level 1 records errors, and why it has none");
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree tree = plusAndDotTree(*object);
    tree.levels[1].error.reset();
    tree.levels[1].stored.reset();
    tree.levels[1].errorUnknown = "too large";
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "") << "nothing was lost";
    for (SphereTreeLevel& level : tree.levels) {
        level.error.reset();
        level.stored.reset();
        level.errorUnknown.clear();
    }
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "") << "they were not asked for";
}

TEST_F(TreeCheck, SaysWhenTheErrorsOfStoredSpheresOfSomeLevelsAreLost)
{
    for (int level : {0, 1, 2}) {
        const std::string name = "level " + std::to_string(level);
        expectFault(
            FaultKind::Records, [=](SphereTree& tree) { tree.levels[level].stored.reset(); },
            name + " records no errors of its stored spheres, though other levels do");
        expectFault(
            FaultKind::Records,
            [=](SphereTree& tree) {
                tree.levels[level].error.reset();
                tree.levels[level].errorUnknown = "too large";
            },
            name + " records errors of its stored spheres, but none without padding");
    }
    expectFault(
        FaultKind::Records, [](SphereTree& tree) { tree.levels[1].storedUnknown = "too large"; },
        "level 1 records errors of its stored spheres, and why it has none");
    expectFault(
        FaultKind::Records,
        [](SphereTree& tree) {
            tree.levels[1].stored.reset();
            tree.levels[1].storedUnknown = "too large";
            tree.levels[1].error.reset();
        },
        "level 1 records why it has no errors of its stored spheres, but none without padding");
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree tree = plusAndDotTree(*object);
    tree.levels[1].stored.reset();
    tree.levels[1].storedUnknown = "too large";
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "") << "nothing was lost";
    for (SphereTreeLevel& level : tree.levels) {
        level.stored.reset();
        level.storedUnknown.clear();
    }
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)), "") << "a file of version 0.1";
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
    const SphereTree whole = plusAndDotTree(*object);
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
    EXPECT_EQ(sentencesOf(checkSphereTree(tree, *object)),
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
    SphereTree reversible = plusAndDotTree(*object, TreeType::Reversible);
    damage(reversible); // nothing that a reversible tree promises
    EXPECT_EQ(sentencesOf(checkSphereTree(reversible, *object)), "");
}

TEST_F(TreeCheck, StopsWhenInterrupted)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    const BoolGrid::Ptr object = plusAndDot();
    EXPECT_THROW(checkSphereTree(plusAndDotTree(*object), *object, &stop), Interrupted);
}

TEST_F(TreeCheck, SaysWhenTheObjectLiesElsewhereInTheWorld)
{
    const BoolGrid::Ptr object = plusAndDot();
    const SphereTree tree = plusAndDotTree(*object);
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
    EXPECT_EQ(sentencesOf(faultsWith(rounded)), "");
}

} // namespace
