// SPDX-License-Identifier: Apache-2.0
/// @file TestDigitalLeaves.cc
/// @brief Whether points lie in the object: all voxels of small boxes, exactly.

#include "QuerySamples.h"
#include "support/CoreStages.h"
#include "support/Messages.h"
#include "support/TreeSettings.h"
#include "support/VectorTarget.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/query/DigitalLeaves.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>
#include <openvdb/math/Transform.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <string>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

/// Calls visit(voxel) for the box of the voxels and two around it.
template <typename Visit>
void forEachAround(const Voxels& voxels, const Visit& visit)
{
    openvdb::CoordBBox box;
    for (const Coord& voxel : voxels) box.expand(voxel);
    box.expand(2);
    for (auto it = box.begin(); it; ++it) visit(*it);
}

/// All voxels, each at a random point of its cube, as often on its edges as not.
void expectContainsObject(
    const QuerySample& sample, const QueryTreeSettings& settings, const std::string& what)
{
    const QueryTree tree = makeQueryTree(sample.tree, settings);
    const DigitalLeaves leaves(sample.tree, settings);
    const std::set<Coord> object(sample.voxels.begin(), sample.voxels.end());
    Random random(31);
    forEachAround(sample.voxels, [&](const Coord& voxel) {
        Vec3d offset;
        for (int axis = 0; axis < 3; ++axis) {
            offset[axis] = std::max(-0.4999, std::min(0.4999, uniform(random, -1, 1)));
        }
        const Vec3d point =
            settings.scale * sample.tree.transform->indexToWorld(voxel.asVec3d() + offset);
        ASSERT_EQ(leaves.voxelOf(point), voxel) << what;
        ASSERT_EQ(contains(tree, leaves, point), object.count(voxel) == 1) << what << voxel;
    });
}

TEST(DigitalLeaves, ContainJustTheVoxelsOfTheObject)
{
    for (const QuerySample& sample : querySamples()) {
        QueryTreeSettings settings;
        expectContainsObject(sample, settings, sample.name);
        settings.exactness = Exactness::LeafUnion;
        settings.scale = 3.7;
        expectContainsObject(sample, settings, "all leaves, scaled: " + sample.name);
    }
}

TEST(DigitalLeaves, DoSoForEveryObjectOf3x2x2)
{
    TightOptions fast;
    fast.quality = Quality::Fast;
    for (unsigned mask = 1; mask < 1u << 12; ++mask) {
        Voxels voxels;
        for (int i = 0; i < 12; ++i) {
            if (mask >> i & 1) voxels.push_back(Coord(i / 4, i / 2 % 2, i % 2));
        }
        const SphereTree built = buildSphereTree(*gridOf(voxels), SphereTreeSettings(fast));
        const QueryTree tree = makeQueryTree(built);
        const DigitalLeaves leaves(built);
        for (int i = 0; i < 5 * 4 * 4; ++i) {
            const Coord voxel(i / 16 - 1, i / 4 % 4 - 1, i % 4 - 1);
            const bool isObject = std::count(voxels.begin(), voxels.end(), voxel) == 1;
            ASSERT_EQ(contains(tree, leaves, voxel.asVec3d()), isObject) << mask << voxel;
        }
    }
}

TEST(DigitalLeaves, DoSoForEveryPaddingAndForAllLeafBalls)
{
    for (uint32_t seed = 40; seed < 70; ++seed) {
        TightOptions options;
        options.quality = Quality::Fast;
        options.leaves = seed % 2 ? Leaves::Medial : Leaves::Pruned;
        SphereTreeSettings settings = options;
        settings.padding = std::array<double, 3>{0, 0.5, SphereTreeSettings::kPadCubes}[seed % 3];
        const RandomObject object = randomObject(seed);
        expectContainsObject(querySample(object.name, object.voxels, settings), {}, object.name);
    }
}

TEST(DigitalLeaves, OfAFlatObjectAreInItsPlane)
{
    SphereTreeSettings settings = ExtendedOptions();
    settings.dim = 2;
    Voxels disc;
    for (const Coord& voxel : shapes::ball(60)) {
        if (voxel[1] == 0) disc.push_back(voxel);
    }
    expectContainsObject(querySample("disc", disc, settings), {}, "disc");
}

TEST(DigitalLeaves, BetweenVoxelsTheOneWithTheLargerCoordinatesCounts)
{
    const auto grid = gridOf(Voxels{Coord(2, 0, 0)});
    TightOptions options;
    options.quality = Quality::Fast;
    const SphereTree built = buildSphereTree(*grid, SphereTreeSettings(options));
    const QueryTree tree = makeQueryTree(built);
    const DigitalLeaves leaves(built);
    EXPECT_TRUE(contains(tree, leaves, Vec3d(1.5, 0, 0)));
    EXPECT_TRUE(contains(tree, leaves, Vec3d(1.5, -0.5, -0.5)));
    EXPECT_FALSE(contains(tree, leaves, Vec3d(std::nextafter(1.5, 0), 0, 0)));
    EXPECT_FALSE(contains(tree, leaves, Vec3d(2.5, 0, 0)));
    const double justBelowHalf = std::nextafter(0.5, 0); // its sum with a half is rounded to 1
    EXPECT_EQ(leaves.voxelOf(Vec3d(justBelowHalf, 0.5, -0.5)), Coord(0, 1, 0));
    EXPECT_EQ(leaves.voxelOf(Vec3d(-justBelowHalf, -1e-300, -1.5)), Coord(0, 0, -1));
    EXPECT_FALSE(contains(tree, leaves, Vec3d(2, 0, 0.5)));
}

TEST(DigitalLeaves, AreTheSameOnEveryVectorTarget)
{
    for (const int64_t target : allTargets()) {
        forceTarget(target);
        expectContainsObject(querySamples()[2], {}, targetName(target));
    }
    forceTarget(0);
}

TEST(DigitalLeaves, OfPointsFarAwayContainNothing)
{
    const QuerySample& sample = querySamples()[0];
    const QueryTree tree = makeQueryTree(sample.tree);
    const DigitalLeaves leaves(sample.tree);
    for (const double far : {1e3, 1e6, 1e9, 1e12, 1e100}) {
        EXPECT_FALSE(contains(tree, leaves, tree.center() + Vec3d(far, -far, far)));
    }
}

TEST(DigitalLeaves, TakeSixteenBytesEach)
{
    const DigitalLeaves leaves(querySamples()[0].tree);
    EXPECT_LE(leaves.bytes(), 16 * leaves.balls().size() + 200);
}

TEST(DigitalLeaves, RefuseTreesWhoseLeavesAreNotTheObject)
{
    const Voxels voxels = randomObject(3).voxels;
    const auto whyNot = [&](const SphereTreeSettings& settings) {
        const QuerySample sample = querySample("", voxels, settings);
        return messageOf<openvdb::ValueError>([&] { DigitalLeaves leaves(sample.tree); });
    };
    EXPECT_TRUE(mentions(whyNot(InnerOptions()), "side=outer"));
    EXPECT_TRUE(mentions(whyNot(FitOptions()), "side=outer"));
    TightOptions few;
    few.quality = Quality::Fast;
    few.budget.spheres = {2, 1};
    EXPECT_TRUE(mentions(whyNot(few), "medial balls"));
    ReversibleOptions norm;
    norm.dist = distanceFromString("l1");
    EXPECT_TRUE(mentions(whyNot(norm), "norm"));

    const QuerySample& sample = querySamples()[0];
    QueryTreeSettings coarse;
    coarse.level = 1;
    EXPECT_TRUE(
        mentions(messageOf<openvdb::ValueError>([&] { DigitalLeaves leaves(sample.tree, coarse); }),
            "coarser"));

    const QueryTree other = makeQueryTree(querySamples()[4].tree);
    const DigitalLeaves leaves(sample.tree);
    EXPECT_TRUE(
        mentions(messageOf<openvdb::ValueError>([&] { contains(other, leaves, Vec3d(0.0)); }),
            "with the same settings"));
    const QuerySample one = querySample("one voxel"),
                      moved = querySample("", {Coord(50, 0, 0)}, TightOptions());
    const DigitalLeaves ofOne(one.tree);
    EXPECT_NO_THROW(contains(makeQueryTree(one.tree), ofOne, Vec3d(0.0)));
    EXPECT_THROW(contains(makeQueryTree(moved.tree), ofOne, Vec3d(0.0)), openvdb::ValueError);
    QueryTreeSettings twice;
    twice.scale = 2;
    EXPECT_THROW(contains(makeQueryTree(one.tree, twice), ofOne, Vec3d(0.0)), openvdb::ValueError);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(
        contains(makeQueryTree(sample.tree), leaves, Vec3d(0, nan, 0)), openvdb::ValueError);
}

} // namespace
