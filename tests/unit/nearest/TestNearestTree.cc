// SPDX-License-Identifier: Apache-2.0
/// @file TestNearestTree.cc
/// @brief Trees with side=fit: stored radii, parents, levels, and what -check holds them to.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/nearest/SharedVoxels.h>
#include <openvdb_spheretree/nearest/StoredSphere.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>

#include "NaiveSpheres.h"
#include "support/BuiltTrees.h"
#include "support/Messages.h"

#include <openvdb_spheretree/base/Interrupted.h>

#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::nearest;
using namespace spheretree_test;

SphereTreeSettings fitSettings(const std::vector<int64_t>& spheres, int dim = 3)
{
    SphereTreeSettings settings = FitOptions();
    settings.budgeted().budget.spheres = spheres;
    settings.dim = dim;
    return settings;
}

openvdb::BoolGrid::Ptr somePart()
{
    Voxels voxels = shapes::box(Coord(21, 9, 7));
    for (const Coord& v : shapes::ball(60)) voxels.push_back(v.offsetBy(25, 4, 3));
    auto grid = gridOf(voxels);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.013));
    return grid;
}

std::string firstFault(const SphereTree& tree, const openvdb::BoolGrid& object)
{
    const auto faults = checkSphereTree(tree, object);
    return faults.empty() ? "" : faults.front().sentence;
}

} // namespace

TEST(StoredSphere, HoldsTheSameVoxelsForAnySizeOfVoxels)
{
    Random random(31);
    const Voxels origin{Coord(0)};
    for (int i = 0; i < 200; ++i) {
        ExactSphere sphere = randomSphere(origin, random, false);
        if (i % 3 == 0) { // the last voxel just inside
            const Coord v = random.coord(-3, 3);
            sphere.radiusSq = 0;
            for (int a = 0; a < 3; ++a) {
                sphere.radiusSq += (16 * v[a] - sphere.center[a]) * (16 * v[a] - sphere.center[a]);
            }
        }
        for (const double voxel : {1.0, 0.013, 1e6 / 3}) {
            const StoredSphere stored = storedSphere(sphere, voxel);
            EXPECT_EQ(naiveVoxels({stored.sphere}, false), naiveVoxels({sphere}, false)) << i;
            EXPECT_EQ(stored.radius, double(stored.radiusWorld) / voxel);
            EXPECT_NEAR(std::sqrt(double(stored.sphere.radiusSq)) / 16, stored.radius, 0.01);
        }
    }
}

TEST(StoredSphere, RefusesRadiiThatFitNoFloat)
{
    const ExactSphere sphere{{0, 0, 0}, 256};
    for (const double voxel : {1e39, 1e-44}) {
        EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { storedSphere(sphere, voxel); }),
            "does not fit a float"));
    }
}

TEST(SharedVoxels, AreThoseInBothSpheres)
{
    Random random(32);
    const Voxels around = shapes::box(Coord(4, 4, 4));
    for (int i = 0; i < 200; ++i) {
        for (const bool flat : {false, true}) {
            const ExactSphere a = randomSphere(around, random, flat);
            const ExactSphere b = randomSphere(around, random, flat);
            const std::set<Coord> inA = naiveVoxels({a}, flat), inB = naiveVoxels({b}, flat);
            int64_t both = 0;
            for (const Coord& v : inA) both += int64_t(inB.count(v));
            EXPECT_EQ(sharedVoxels(a, b, flat), both);
        }
    }
}

TEST(SharedVoxels, TheParentIsTheFirstThatSharesMost)
{
    const ExactSphere far{{640, 0, 0}, 1600}, near{{80, 0, 0}, 1600}, large{{48, 0, 0}, 1600};
    const ExactSphere child{{0, 0, 0}, 1600}, lost{{-640, 0, 0}, 64};
    EXPECT_EQ(parentsOf({child, lost}, {far, near, large, large}, false, nullptr),
        (std::vector<int32_t>{2, 2}));
    EXPECT_EQ(parentsOf({child}, {far}, false, nullptr), std::vector<int32_t>{0});
}

TEST(NearestTree, KeepsWhatCheckAsksForAndIsReadBack)
{
    const auto object = somePart();
    SphereTree tree = buildSphereTree(*object, fitSettings({2, 30, 8}));
    computeLevelErrors(tree, *object);
    ASSERT_EQ(tree.levels.size(), 3u);
    EXPECT_EQ(tree.levels[0].size(), 30);
    EXPECT_EQ(tree.levels[2].size(), 2);
    EXPECT_EQ(firstFault(tree, *object), "");
    for (const SphereTreeLevel& level : tree.levels) {
        EXPECT_EQ(storedSpheres(tree, level), levelSpheres(tree, level));
        EXPECT_EQ(level.stored->hammingPercent, level.error->hammingPercent);
        if (level.level == 0) continue;
        EXPECT_GE(level.error->hammingPercent, tree.levels[level.level - 1].error->hammingPercent);
    }
    const SphereTree read = fromPoints(*toPoints(tree));
    EXPECT_TRUE(sameNodes(tree, read));
    EXPECT_TRUE(read.settings.isFit());
    EXPECT_EQ(firstFault(read, *object), "");
}

TEST(NearestTree, CheckFindsErrorsParentsAndRadiiThatAreNotSo)
{
    const auto object = somePart();
    SphereTree tree = buildSphereTree(*object, fitSettings({12, 3}));
    computeLevelErrors(tree, *object);
    SphereTree wrong = tree;
    wrong.levels[0].error->missing += 1;
    EXPECT_NE(firstFault(wrong, *object), "");
    wrong = tree;
    wrong.levels[1].stored->hammingPercent += 1;
    EXPECT_NE(firstFault(wrong, *object), "");
    wrong = tree;
    wrong.spheres.parent[5] = 5;
    EXPECT_NE(firstFault(wrong, *object), "");
    wrong = tree;
    wrong.spheres.radiusWorld[4] *= 1.001f;
    EXPECT_TRUE(mentions(firstFault(wrong, *object), "the stored radius is not the radius"));
    wrong.spheres.radiusWorld[4] = tree.spheres.radiusWorld[4] * 0.999f;
    EXPECT_TRUE(mentions(firstFault(wrong, *object), "the stored radius is not the radius"));
}

TEST(NearestTree, ANodeNeedsNoChild)
{
    const auto object = somePart();
    SphereTree tree = buildSphereTree(*object, fitSettings({12, 3}));
    for (int32_t& parent : tree.spheres.parent) parent = std::min(parent, 0);
    EXPECT_EQ(firstFault(tree, *object), "");
}

TEST(NearestTree, AllInnerSpheresAreTheObject)
{
    const auto object = somePart();
    SphereTree tree = buildSphereTree(*object, fitSettings({}));
    computeLevelErrors(tree, *object);
    EXPECT_EQ(tree.levels[0].error->hammingPercent, 0);
    EXPECT_EQ(tree.root().size(), 1);
    EXPECT_EQ(firstFault(tree, *object), "");
}

TEST(NearestTree, NoLevelIsWorseThanACoarserOne)
{
    for (const RandomObject& object : someObjects(0, 20)) {
        const auto grid = gridOf(object.voxels);
        SphereTree tree = buildSphereTree(*grid, fitSettings({1, 2, 3, 4, 5, 6, 7, 8, 12, 16}));
        computeLevelErrors(tree, *grid);
        for (std::size_t k = 1; k < tree.levels.size(); ++k) {
            EXPECT_GE(
                tree.levels[k].error->hammingPercent, tree.levels[k - 1].error->hammingPercent)
                << object.name << ", level " << k;
        }
        EXPECT_EQ(firstFault(tree, *grid), "") << object.name;
    }
}

TEST(NearestTree, FlatObjectsHaveDiscsInTheirPlane)
{
    for (int axis = 0; axis < 3; ++axis) {
        Voxels voxels;
        for (const Coord& v : flattened(shapes::ball(70, 20))) {
            Coord turned(v[0], v[1], 5);
            std::swap(turned[2], turned[axis]);
            voxels.push_back(turned);
        }
        const auto grid = gridOf(voxels);
        SphereTree tree = buildSphereTree(*grid, fitSettings({8, 2}, 2));
        computeLevelErrors(tree, *grid);
        EXPECT_LT(tree.levels[0].error->hammingPercent, 30);
        for (const auto& center : tree.spheres.center) EXPECT_EQ(center[axis], 5);
        EXPECT_EQ(firstFault(tree, *grid), "") << axis;
    }
}

TEST(NearestTree, ABoundOnTheErrorIsKept)
{
    const auto object = somePart();
    SphereTreeSettings settings = fitSettings({});
    settings.budgeted().budget.error = 8;
    settings.budgeted().budget.branching = 2;
    SphereTree tree = buildSphereTree(*object, settings);
    computeLevelErrors(tree, *object);
    EXPECT_LE(tree.levels[0].stored->hammingPercent, 8);
    ASSERT_GT(tree.levels.size(), 2u);
    EXPECT_GT(tree.levels[1].stored->hammingPercent, 8);
    EXPECT_EQ(tree.root().size(), 1);
    settings.budgeted().budget.branching = 0;
    settings.budgeted().budget.spheres = {2};
    EXPECT_TRUE(
        mentions(messageOf<openvdb::ValueError>([&] { buildSphereTree(*object, settings); }),
            "error=8 cannot be reached with spheres=2"));
}

TEST(NearestTree, IsTheSameForAnyNumberOfThreads)
{
    using Control = tbb::global_control;
    const auto object = somePart();
    const Control one(Control::max_allowed_parallelism, 1);
    const SphereTree alone = buildSphereTree(*object, fitSettings({40, 5}));
    const Control two(Control::max_allowed_parallelism, 2);
    EXPECT_TRUE(sameNodes(alone, buildSphereTree(*object, fitSettings({40, 5}))));
}

TEST(NearestTree, CanBeInterruptedAnywhere)
{
    struct Stopper : openvdb::util::NullInterrupter {
        std::atomic<int> left{0};
        bool wasInterrupted(int) override { return --left < 0; }
    };
    const auto object = somePart();
    for (const int asked : {0, 5, 20, 60, 150}) {
        Stopper stopper;
        stopper.left = asked;
        EXPECT_THROW(
            buildSphereTree(*object, fitSettings({40, 5}), nullptr, &stopper), Interrupted);
    }
}
