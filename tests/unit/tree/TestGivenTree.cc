// SPDX-License-Identifier: Apache-2.0
/// @file TestGivenTree.cc
/// @brief Spheres of others as a tree: the voxels that they hold, against a test of each voxel in
/// doubles; and what cannot be held.

#include <openvdb_spheretree/tree/GivenTree.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>

#include "support/Messages.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace {

using namespace openvdb_spheretree;
using openvdb::Coord;
using openvdb::Vec3d;
using spheretree_test::mentions;
using spheretree_test::messageOf;

/// A block of voxels in a turned world.
openvdb::BoolGrid::Ptr block()
{
    const auto grid = openvdb::BoolGrid::create();
    grid->setName("block");
    const auto transform = openvdb::math::Transform::createLinearTransform(0.1);
    transform->postRotate(0.4, openvdb::math::Z_AXIS);
    transform->postTranslate({10, -3, 0.07});
    grid->setTransform(transform);
    grid->fill(openvdb::CoordBBox(Coord(-9, -4, 2), Coord(9, 11, 14)), true);
    return grid;
}

WorldSpheres randomSpheres(const openvdb::BoolGrid& object, int count, unsigned seed)
{
    std::mt19937 random(seed);
    const auto between = [&](double lo, double hi) {
        return lo + (hi - lo) * double(random() % 100003) / 100003;
    };
    WorldSpheres spheres;
    spheres.name = "random";
    for (int i = 0; i < count; ++i) {
        spheres.center.push_back(object.transform().indexToWorld(
            Vec3d(between(-9, 9), between(-4, 11), between(2, 14))));
        spheres.radius.push_back(between(0.01, 0.5));
    }
    return spheres;
}

} // namespace

TEST(GivenTree, HoldsJustTheVoxelsWhoseCentersAreInASphere)
{
    openvdb::initialize();
    const auto object = block();
    for (unsigned seed = 0; seed < 20; ++seed) {
        const WorldSpheres spheres = randomSpheres(*object, 1 + int(seed) % 5, seed);
        const SphereTree tree = givenTree(spheres, *object);
        EXPECT_NO_THROW(tree.validate());
        const auto covered = levelUnion(tree, tree.levels[0]);
        const openvdb::CoordBBox around(Coord(-20, -15, -9), Coord(20, 22, 25));
        int64_t inside = 0, doubtful = 0;
        for (auto q = around.begin(); q; ++q) {
            double nearest = 1e9; // to a sphere, in voxels; negative inside
            for (std::size_t i = 0; i < spheres.size(); ++i) {
                const Vec3d at = object->transform().indexToWorld(*q);
                const double apart = (at - spheres.center[i]).length() - spheres.radius[i];
                nearest = std::min(nearest, apart / 0.1);
            }
            if (std::abs(nearest) < 0.00086) ++doubtful;
            else ASSERT_EQ(covered->isValueOn(*q), nearest < 0) << *q;
            inside += nearest < 0;
        }
        EXPECT_GT(inside, 0);
        EXPECT_LT(doubtful, 30);
    }
}

TEST(GivenTree, ASphereThatEndsOnAVoxelCenterHoldsIt)
{
    const auto object = openvdb::BoolGrid::create();
    object->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
    object->fill(openvdb::CoordBBox(Coord(0), Coord(9)), true);
    for (int reach = 1; reach < 50; ++reach) {
        WorldSpheres spheres;
        spheres.center = {Vec3d(0.3, 0.1, 0.7)};
        spheres.radius = {0.1 * reach};
        const SphereTree tree = givenTree(spheres, *object);
        const auto covered = levelUnion(tree, tree.levels[0]);
        EXPECT_TRUE(covered->isValueOn(Coord(3 + reach, 1, 7))) << reach;
        EXPECT_FALSE(covered->isValueOn(Coord(4 + reach, 1, 7))) << reach;
    }
}

TEST(GivenTree, KeepsTheOrderAndTheRadiiOfTheFile)
{
    const auto object = block();
    const WorldSpheres spheres = randomSpheres(*object, 40, 7);
    for (const SphereTree& tree : {givenTree(spheres, *object), givenTree(spheres)}) {
        EXPECT_TRUE(tree.settings.isGiven());
        ASSERT_EQ(tree.size(), 40);
        ASSERT_EQ(tree.levels.size(), 1u);
        const WorldSpheres back = worldSpheres(tree);
        for (int32_t id = 0; id < 40; ++id) {
            EXPECT_LT((back.center[id] - spheres.center[id]).length(), 0.00086 * tree.voxelSize());
            EXPECT_GE(back.radius[id], spheres.radius[id]);
            EXPECT_LT(back.radius[id], spheres.radius[id] * (1 + 2e-7));
            EXPECT_EQ(tree.spheres.parent[id], -1);
        }
    }
}

TEST(GivenTree, AFrameOfItsOwnHasUpTo256VoxelsAlongTheBoxAndNoObject)
{
    WorldSpheres spheres;
    spheres.center = {Vec3d(0, 5, 1e4), Vec3d(9, 5, 1e4)};
    spheres.radius = {1, 2};
    const SphereTree tree = givenTree(spheres);
    EXPECT_EQ(tree.object.voxels, 0);
    EXPECT_EQ(tree.voxelSize(), 1.0 / 16);
    const Coord size = tree.object.bbox.dim();
    EXPECT_NEAR(size[0], 12 * 16, 1);
    EXPECT_NEAR(size[1], 4 * 16, 1);
}

TEST(GivenTree, AnObjectMayReachFromTheFirstCoordinateToTheLast)
{
    const auto object = openvdb::BoolGrid::create();
    for (const int x : {INT32_MIN, INT32_MAX}) object->tree().setValueOn(Coord(x, 0, 0), true);
    WorldSpheres spheres;
    spheres.center = {Vec3d(0, 5, 1)};
    spheres.radius = {2};
    const SphereTree tree = givenTree(spheres, *object);
    EXPECT_EQ(tree.object.bbox.max()[0], INT32_MAX);
    EXPECT_NO_THROW(tree.validate());
}

TEST(GivenTree, WhatNoVoxelsAreThereForIsRefusedByItsId)
{
    const auto object = block();
    WorldSpheres spheres = randomSpheres(*object, 3, 1);
    spheres.radius[1] = 1e6;
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([&] { givenTree(spheres, *object); }), "sphere 1 of"));
    spheres.radius[1] = 1;
    spheres.center[2][0] = 1e9;
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([&] { givenTree(spheres, *object); }), "too far away"));
    spheres.center[2][0] = 1e308;
    EXPECT_THROW(givenTree(spheres), openvdb::ValueError);
    EXPECT_THROW(givenTree(WorldSpheres()), openvdb::ValueError);
    spheres.center.assign(1, Vec3d(1e11, 0, 0));
    spheres.radius.assign(1, 1e-9);
    EXPECT_NO_THROW(givenTree(spheres).validate());
}

/// No transform of OpenVDB has a voxel that is lost beside its distance from the origin.
TEST(GivenTree, SpheresTooFarAwayForTheirSizeAreRefusedBeforeTheyAreWritten)
{
    WorldSpheres spheres;
    spheres.name = "far";
    spheres.center.assign(1, Vec3d(0, -7e13, 0));
    spheres.radius.assign(1, 1);
    EXPECT_NO_THROW(givenTree(spheres).transform->baseMap()->getAffineMap());
    spheres.center.front()[1] = -8e13;
    const std::string message = messageOf<openvdb::ValueError>([&] { givenTree(spheres); });
    EXPECT_TRUE(mentions(message, "'far' are 8e+13 away from the origin")) << message;
    spheres.radius.front() = 100;
    EXPECT_NO_THROW(givenTree(spheres).validate());
}
