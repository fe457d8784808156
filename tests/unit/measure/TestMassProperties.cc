// SPDX-License-Identifier: Apache-2.0
/// @file TestMassProperties.cc
/// @brief Volume, center of mass and inertia against formulas of solids, and against voxels one by
/// one.

#include <openvdb_spheretree/measure/MassProperties.h>

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>

#include "support/RandomObjects.h"

#include <gtest/gtest.h>
#include <openvdb/math/Maps.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <limits>

namespace {

using namespace openvdb_spheretree;
using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Mat3d;
using openvdb::Mat4d;
using openvdb::Vec3d;
using openvdb::math::Transform;

class MassPropertiesTest : public ::testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }
};

BoolGrid::Ptr box(const CoordBBox& voxels)
{
    BoolGrid::Ptr grid = BoolGrid::create(false);
    grid->fill(voxels, true);
    return grid;
}

void expectNear(const Vec3d& a, const Vec3d& b, double tolerance)
{
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "axis " << i;
}

void expectNear(const Mat3d& a, const Mat3d& b, double tolerance)
{
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(a(i / 3, i % 3), b(i / 3, i % 3), tolerance) << i;
}

/// By definition: cubes of one voxel about their common center.
void expectThoseOf(const spheretree_test::Voxels& voxels, const MassProperties& found)
{
    Vec3d center(0);
    for (const Coord& ijk : voxels) center += ijk.asVec3d();
    center /= double(voxels.size());
    Mat3d inertia = double(voxels.size()) / 6 * Mat3d::identity();
    for (const Coord& ijk : voxels) {
        const Vec3d r = ijk.asVec3d() - center;
        inertia += r.lengthSqr() * Mat3d::identity() - openvdb::math::outerProduct(r, r);
    }
    EXPECT_EQ(found.volume, double(voxels.size()));
    expectNear(found.center, center, 1e-9 * (1 + center.length()));
    expectNear(found.inertia, inertia, 1e-8 * inertia.trace());
}

TEST_F(MassPropertiesTest, OfRandomObjectsAreThoseOfTheirVoxelsOneByOne)
{
    for (uint32_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        const auto object = spheretree_test::randomObject(seed);
        const BoolGrid::Ptr grid = BoolGrid::create(false);
        for (const Coord& ijk : object.voxels) grid->tree().setValueOn(ijk, true);
        const auto found = massProperties(*grid);
        ASSERT_TRUE(found);
        expectThoseOf(object.voxels, *found);
    }
}

TEST_F(MassPropertiesTest, OfABoxAreExact)
{
    const BoolGrid::Ptr grid = box(CoordBBox(Coord(0), Coord(1, 2, 5))); // 2 x 3 x 6
    grid->setTransform(Transform::createLinearTransform(0.5));           // 1 x 1.5 x 3
    const auto found = massProperties(*grid);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->volume, 4.5);
    EXPECT_EQ(found->center, Vec3d(0.25, 0.5, 1.25));
    const double m = 4.5 / 12;
    const Vec3d moments(m * (2.25 + 9), m * (1 + 9), m * (1 + 2.25));
    expectNear(found->inertia,
        Mat3d(moments[0], 0.0, 0.0, 0.0, moments[1], 0.0, 0.0, 0.0, moments[2]), 1e-14);
    expectNear(found->principalMoments, Vec3d(moments[2], moments[1], moments[0]), 1e-14);
    EXPECT_EQ(found->principalAxes, Mat3d(0, 0, 1, 0, 1, 0, -1, 0, 0));
}

TEST_F(MassPropertiesTest, OfATileOfManyVoxelsAreThoseOfACube)
{
    const BoolGrid::Ptr grid = BoolGrid::create(false);
    grid->tree().addTile(3, Coord(0), true, true);
    const auto found = massProperties(*grid);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->volume, 0x1p36);
    EXPECT_EQ(found->center, Vec3d(2047.5));
    const double moment = 0x1p36 * 0x1p24 / 6;
    EXPECT_EQ(found->principalMoments, Vec3d(moment));
    EXPECT_EQ(found->principalAxes, Mat3d::identity());
}

TEST_F(MassPropertiesTest, LoseNothingFarFromTheOrigin)
{
    const auto object = spheretree_test::randomObject(7);
    const BoolGrid::Ptr near = BoolGrid::create(false), far = BoolGrid::create(false);
    const Coord offset(1 << 27, -(1 << 27), (1 << 27) + 3);
    for (const Coord& ijk : object.voxels) {
        near->tree().setValueOn(ijk, true);
        far->tree().setValueOn(ijk + offset, true);
    }
    const auto a = massProperties(*near), b = massProperties(*far);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->volume, b->volume);
    EXPECT_EQ(a->inertia, b->inertia); // to the last bit
    EXPECT_EQ(a->principalAxes, b->principalAxes);
    expectNear(b->center - offset.asVec3d(), a->center, 3e-8); // doubles have no more there
}

TEST_F(MassPropertiesTest, OfTwoVoxelsAtTheEndsOfSpaceAreThoseOfADumbbell)
{
    const BoolGrid::Ptr grid = BoolGrid::create(false);
    const int32_t end = std::numeric_limits<int32_t>::max() - 8;
    grid->tree().setValueOn(Coord(end, 0, 0), true);
    grid->tree().setValueOn(Coord(-end, 0, 0), true);
    const auto found = massProperties(*grid);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->center, Vec3d(0));
    EXPECT_DOUBLE_EQ(found->principalMoments[0], 2.0 / 6);
    EXPECT_DOUBLE_EQ(found->principalMoments[2], 2.0 * end * end);
}

TEST_F(MassPropertiesTest, OfABallAreTwoFifthsOfItsMassTimesItsRadiusSquared)
{
    const BoolGrid::Ptr grid = BoolGrid::create(false);
    const double radius = 40;
    const ExactSphere sphere = ExactSphere::around(Coord(5, -7, 900), int64_t(4 * radius * radius));
    const auto voxels = sphereUnion({sphere}, boundingBox({sphere}));
    const auto found = massProperties(*voxels, grid->transform());
    ASSERT_TRUE(found);
    const double mass = 4.0 / 3 * M_PI * std::pow(radius, 3);
    EXPECT_NEAR(found->volume / mass, 1, 2e-3);
    EXPECT_EQ(found->center, Vec3d(5, -7, 900));
    const double moment = 0.4 * mass * radius * radius;
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(found->principalMoments[a] / moment, 1, 2e-3);
    EXPECT_EQ(found->principalAxes, Mat3d::identity());
}

/// What a map does to a body: steps of index space become steps of the world.
void expectTensorLaw(const Mat4d& affine)
{
    const auto object = spheretree_test::randomObject(11);
    const BoolGrid::Ptr grid = BoolGrid::create(false);
    for (const Coord& ijk : object.voxels) grid->tree().setValueOn(ijk, true);
    const auto before = massProperties(*grid);
    grid->setTransform(Transform::Ptr(
        new Transform(openvdb::math::MapBase::Ptr(new openvdb::math::AffineMap(affine)))));
    const auto after = massProperties(*grid);
    ASSERT_TRUE(before && after);
    const Mat3d rows = affine.getMat3(); // of row vectors
    const double factor = std::abs(rows.det());
    EXPECT_NEAR(after->volume, factor * before->volume, 1e-12 * after->volume);
    expectNear(after->center, affine.transform(before->center), 1e-9);
    const Mat3d spread =
        0.5 * before->inertia.trace() * Mat3d::identity() - before->inertia; // integral of r r^T
    const Mat3d moved = factor * (rows.transpose() * spread * rows);
    expectNear(
        after->inertia, moved.trace() * Mat3d::identity() - moved, 1e-12 * after->inertia.trace());
    EXPECT_EQ(after->inertia, after->inertia.transpose());
    EXPECT_NEAR(after->principalAxes.det(), 1, 1e-14);
}

TEST_F(MassPropertiesTest, FollowTheTransform)
{
    Mat4d affine = Mat4d::identity();
    affine.postRotate(openvdb::math::X_AXIS, 0.7);
    affine.postRotate(openvdb::math::Z_AXIS, -1.9);
    affine.postTranslate(Vec3d(3, -100, 0.5));
    {
        SCOPED_TRACE("turned");
        expectTensorLaw(affine);
    }
    affine.preScale(Vec3d(0.25, 0.25, -0.25));
    {
        SCOPED_TRACE("turned, scaled and mirrored");
        expectTensorLaw(affine);
    }
    affine.preScale(Vec3d(1, 2, 5));
    affine.preShear(openvdb::math::X_AXIS, openvdb::math::Y_AXIS, 0.5);
    {
        SCOPED_TRACE("boxes, sheared");
        expectTensorLaw(affine);
    }
}

TEST_F(MassPropertiesTest, ThereAreNoneOfNothing)
{
    EXPECT_FALSE(massProperties(*BoolGrid::create(false)));
}

TEST_F(MassPropertiesTest, AFrustumIsRefused)
{
    const BoolGrid::Ptr grid = box(CoordBBox(Coord(0), Coord(3)));
    grid->setTransform(
        Transform::createFrustumTransform(openvdb::BBoxd(Vec3d(0), Vec3d(10)), 0.5, 2));
    EXPECT_THROW(massProperties(*grid), openvdb::ValueError);
}

TEST_F(MassPropertiesTest, OfALevelAreThoseOfTheVoxelsInItsStoredSpheres)
{
    const BoolGrid::Ptr grid = box(CoordBBox(Coord(-3, 2, 7), Coord(19, 12, 30)));
    grid->setTransform(Transform::createLinearTransform(0.1));
    SphereTreeSettings settings;
    settings.padding = 0.75;
    const SphereTree tree = buildSphereTree(*grid, settings);
    for (const SphereTreeLevel& level : tree.levels) {
        const auto spheres = storedSpheres(tree, level);
        const auto voxels = sphereUnion(spheres, levelBox(tree, spheres), metricOf(tree));
        const auto expected = massProperties(*voxels, *tree.transform);
        const auto found = massProperties(tree, level);
        ASSERT_TRUE(expected && found);
        EXPECT_EQ(found->volume, expected->volume);
        EXPECT_EQ(found->inertia, expected->inertia);
        EXPECT_GT(found->volume, massProperties(*grid)->volume); // padding holds more voxels
    }
}

TEST_F(MassPropertiesTest, ALevelThatCrossesTooManyRowsIsRefused)
{
    const BoolGrid::Ptr grid = BoolGrid::create(false);
    grid->tree().setValueOn(Coord(0), true);
    grid->tree().setValueOn(Coord(1 << 20), true);
    const SphereTree tree = buildSphereTree(*grid, SphereTreeSettings());
    EXPECT_THROW(massProperties(tree, tree.root()), openvdb::ValueError);
    EXPECT_EQ(massProperties(tree, tree.level(0))->volume, 2);
}

} // namespace
