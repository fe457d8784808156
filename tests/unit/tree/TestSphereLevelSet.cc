// SPDX-License-Identifier: Apache-2.0
/// @file TestSphereLevelSet.cc
/// @brief Level sets of a level's spheres against distances to each of the spheres.

#include "support/BuiltTrees.h"
#include "support/CoreStages.h"
#include "support/Messages.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/tree/SphereLevelSet.h>

#include <openvdb/openvdb.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// The distance to the nearest of a level's stored spheres, negative inside one.
double distanceTo(const SphereTree& tree, const SphereTreeLevel& level, const openvdb::Vec3d& point)
{
    double nearest = std::numeric_limits<double>::max();
    for (int32_t id = level.begin; id < level.end; ++id) {
        nearest = std::min(nearest,
            (tree.centerWorld(id) - point).length() - double(tree.spheres.radiusWorld[id]));
    }
    return nearest;
}

SphereTree treeOf(uint32_t seed)
{
    return buildSphereTree(*gridOf(randomObject(seed).voxels), settingsFor(TreeType::Extended));
}

} // namespace

TEST(SphereLevelSet, HoldsTheDistanceToTheNearestSphereInItsNarrowBand)
{
    for (uint32_t seed = 1; seed < 5; ++seed) {
        const SphereTree tree = treeOf(seed);
        for (const SphereTreeLevel& level : tree.levels) {
            for (const double voxel : {tree.voxelSize(), 0.4 * tree.voxelSize()}) {
                const auto grid = levelSetOfSpheres(tree, level, voxel, 3);
                ASSERT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
                int64_t outside = 0; // inside spheres that overlap, the band is of each of them
                for (auto value = grid->cbeginValueOn(); value; ++value) {
                    const double distance =
                        distanceTo(tree, level, grid->indexToWorld(value.getCoord()));
                    if (distance < 0) continue;
                    ++outside;
                    ASSERT_NEAR(*value, distance, 1e-4 * voxel) << seed << ' ' << level.level;
                }
                EXPECT_GT(outside, 0);
            }
        }
    }
}

TEST(SphereLevelSet, EveryVoxelOfTheObjectIsInside)
{
    const RandomObject object = randomObject(3);
    const SphereTree tree =
        buildSphereTree(*gridOf(object.voxels), settingsFor(TreeType::Extended));
    for (const SphereTreeLevel& level : tree.levels) {
        const auto grid = levelSetOfSpheres(tree, level);
        EXPECT_EQ(grid->transform(), *tree.transform);
        for (const openvdb::Coord& voxel : object.voxels) {
            ASSERT_LE(grid->tree().getValue(voxel), 0) << voxel;
        }
    }
}

TEST(SphereLevelSet, WhatCannotBeDrawnIsAnError)
{
    const SphereTree tree = treeOf(1);
    const SphereTreeLevel& level = tree.levels.front();
    for (const double voxel : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW(levelSetOfSpheres(tree, level, voxel), openvdb::ValueError);
    }
    EXPECT_THROW(levelSetOfSpheres(tree, level, 1.0, 0.5), openvdb::ValueError);
    for (const SphereTreeSettings& settings : normSettings(TreeType::Extended, 3)) {
        const SphereTree other = buildSphereTree(*gridOf(randomObject(1).voxels), settings);
        EXPECT_TRUE(mentions(
            messageOf<openvdb::ValueError>([&] { levelSetOfSpheres(other, other.levels.front()); }),
            "no spheres"));
    }
    StopAfter stop(0);
    EXPECT_THROW(levelSetOfSpheres(tree, level, {}, 3, &stop), Interrupted);
}

/// OpenVDB takes most of these voxels for no cubes.
TEST(SphereLevelSet, OfTurnedVoxelsOfAnySizeIsThatOfOthers)
{
    for (const double voxel : {1e-4, 1e-3, 1.0, 1e3, 1e6}) {
        SphereTree straight = treeOf(1);
        straight.transform = openvdb::math::Transform::createLinearTransform(voxel);
        const double scale = voxel / treeOf(1).voxelSize();
        for (float& radius : straight.spheres.radiusWorld) radius = float(radius * scale);
        const auto expected = levelSetOfSpheres(straight, straight.levels.front());
        for (int i = 0; i < 5; ++i) {
            SphereTree turned = straight;
            turned.transform = straight.transform->copy();
            turned.transform->postRotate(0.3 + i, openvdb::math::X_AXIS);
            turned.transform->postRotate(0.7 * i + 0.1, openvdb::math::Z_AXIS);
            const auto found = levelSetOfSpheres(turned, turned.levels.front());
            EXPECT_TRUE(found->transform() == *turned.transform);
            for (auto value = expected->cbeginValueOn(); value; ++value) {
                if (*value < -0.5 * voxel) continue; // what overlaps there depends on rounding
                const float other = found->tree().getValue(value.getCoord());
                ASSERT_NEAR(other / voxel, *value / voxel, 1e-3) << voxel << ' ' << i;
            }
        }
    }
}

/// There OpenVDB's voxel size is 0.6 % off, and places are rounded to a sixteenth of a voxel.
TEST(SphereLevelSet, OfTurnedVoxelsFarAwayIsThatOfOthers)
{
    const SphereTree straight = treeOf(1);
    const double voxel = straight.voxelSize();
    const auto expected = levelSetOfSpheres(straight, straight.levels.front());
    SphereTree far = straight;
    far.transform = straight.transform->copy();
    far.transform->postRotate(0.3, openvdb::math::Z_AXIS);
    far.transform->postTranslate(openvdb::Vec3d(1e14, 2e14, 3e14) * voxel);
    const auto found = levelSetOfSpheres(far, far.levels.front());
    EXPECT_TRUE(found->transform() == *far.transform);
    EXPECT_EQ(found->activeVoxelCount(), expected->activeVoxelCount());
    for (auto value = expected->cbeginValueOn(); value; ++value) {
        ASSERT_NEAR(found->tree().getValue(value.getCoord()), *value, 1e-6 * voxel);
    }
}

TEST(SphereLevelSet, OfVoxelsThatAreNoCubesNeedsAVoxelSize)
{
    SphereTree tree = treeOf(1);
    tree.transform = tree.transform->copy();
    tree.transform->preScale(openvdb::Vec3d(1, 1, 1.01));
    EXPECT_TRUE(
        mentions(messageOf<openvdb::ValueError>([&] { levelSetOfSpheres(tree, tree.levels[0]); }),
            "no cubes"));
    EXPECT_NO_THROW(levelSetOfSpheres(tree, tree.levels[0], 1.0));
}

TEST(SphereLevelSet, RefusesBeforehandWhatWouldTakeTooManyVoxels)
{
    const SphereTree tree = treeOf(1);
    const auto whyNot = [&](double voxel, double width) {
        return messageOf<openvdb::ValueError>(
            [&] { levelSetOfSpheres(tree, tree.levels.back(), voxel, width); });
    };
    const double radius = tree.spheres.radiusWorld[0];
    const std::string fine = whyNot(radius / 1000, 3); // 4 10^9 voxels
    EXPECT_TRUE(mentions(fine, "voxels inside and near its 1 spheres"));
    EXPECT_TRUE(mentions(fine, "1073741824 is the most: use a larger voxel"));
    EXPECT_TRUE(mentions(whyNot(tree.voxelSize(), 900), "a narrower band"));
    SphereTree far = tree;
    far.transform->postTranslate(openvdb::Vec3d(1e7, 0, 0));
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>(
                             [&] { levelSetOfSpheres(far, far.levels.back(), 1e-4 * radius, 1); }),
        "beyond 2^30"));
}
