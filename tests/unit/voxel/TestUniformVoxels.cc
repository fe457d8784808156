// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include "support/Messages.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

using namespace openvdb_spheretree;
using openvdb::BoolGrid;
using openvdb::Coord;
using spheretree_test::mentions;
using spheretree_test::messageOf;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A BoolGrid of one voxel under the given transform.
BoolGrid::Ptr dotWith(const openvdb::math::Transform::Ptr& transform)
{
    const auto grid = BoolGrid::create(false);
    grid->setName("dot");
    grid->tree().setValueOn(Coord(1, 2, 3), true);
    grid->setTransform(transform);
    return grid;
}

openvdb::math::Transform::Ptr mapped(const openvdb::math::MapBase::Ptr& map)
{
    return std::make_shared<openvdb::math::Transform>(map);
}

std::string whyNot(const openvdb::GridBase& grid)
{
    return messageOf<openvdb::ValueError>([&] { requireUniformVoxels(grid); });
}

} // namespace

TEST(UniformVoxels, VoxelsThatAreNotCubesAreAnErrorThatNamesGridAndSize)
{
    using namespace openvdb::math;
    for (const MapBase::Ptr& map : {MapBase::Ptr(new ScaleMap({1, 1, 2})),
             MapBase::Ptr(new ScaleMap({1e-4, 1e-4, 2e-4})), // small enough for OpenVDB's tolerance
             MapBase::Ptr(new ScaleTranslateMap({2, 1, 1}, {5, 5, 5})),
             MapBase::Ptr(new ScaleMap({2e-5, 2e-5, 2.05e-5})),
             MapBase::Ptr(new ScaleMap({1, 1.00001, 1}))}) {
        const std::string why = whyNot(*dotWith(mapped(map)));
        EXPECT_TRUE(mentions(why, "'dot'"));
        EXPECT_TRUE(mentions(why, " x "));
        EXPECT_TRUE(mentions(why, "resample"));
        EXPECT_FALSE(hasCubicVoxels(*mapped(map)));
    }
    const auto sheared = Transform::createLinearTransform(1.0);
    sheared->preShear(0.5, X_AXIS, Y_AXIS);
    EXPECT_TRUE(mentions(whyNot(*dotWith(sheared)), "sheared"));
    EXPECT_FALSE(hasCubicVoxels(*sheared));
}

TEST(UniformVoxels, AxesThatLeanALittleTowardsOneAnotherOrApartAreSheared)
{
    for (double size : {1e-4, 1.0, 1e5}) {
        for (double lean : {0.3, -0.3, 1e-5, -1e-5}) {
            for (int i = 0; i < 3; ++i) {
                const int j = (i + 1) % 3;
                openvdb::Mat4d matrix = openvdb::Mat4d::identity();
                matrix(i, i) = std::sqrt(1 - lean * lean); // edges of one length
                matrix(i, j) = lean;
                for (int a = 0; a < 3; ++a) {
                    for (int b = 0; b < 3; ++b) matrix(a, b) *= size;
                }
                const auto transform = openvdb::math::Transform::createLinearTransform(matrix);
                EXPECT_TRUE(mentions(whyNot(*dotWith(transform)), "sheared"))
                    << size << ' ' << lean << ' ' << i;
            }
        }
    }
}

/// OpenVDB's own number is the distance between two places, and loses digits with the distance.
TEST(UniformVoxels, TheVoxelSizeIsTheSameWhereverTheObjectIs)
{
    for (const double size : {1.0, 0.1, 12345.678}) {
        openvdb::Mat4d matrix = openvdb::Mat4d::identity();
        matrix.preScale(openvdb::Vec3d(size));
        matrix.postRotate(openvdb::math::Z_AXIS, 0.3);
        const double near = voxelSizeOf(*openvdb::math::Transform::createLinearTransform(matrix));
        EXPECT_NEAR(near, size, 1e-15 * size);
        for (const double far : {0.0, 1e8, 1e14}) {
            openvdb::Mat4d placed = matrix;
            placed.postTranslate(openvdb::Vec3d(far, 2 * far, 3 * far) * size);
            const auto transform = openvdb::math::Transform::createLinearTransform(placed);
            EXPECT_EQ(voxelSizeOf(*transform), near) << far;
            const double off = std::abs(transform->voxelSize()[0] / size - 1);
            EXPECT_EQ(off > 1e-12, far > 0) << far;
        }
        EXPECT_EQ(voxelSizeOf(*openvdb::math::Transform::createLinearTransform(size)), size);
    }
}

TEST(UniformVoxels, NoDirectionIsStretchedMoreThanTheLargestStretch)
{
    std::mt19937 random(3);
    for (double lean : {0.0, 5e-7, -5e-7}) {
        openvdb::Mat4d matrix = openvdb::Mat4d::identity();
        matrix(0, 0) = 1 + 1e-7;
        matrix(0, 1) = matrix(1, 2) = lean;
        const auto transform = openvdb::math::Transform::createLinearTransform(matrix);
        const double stretch = largestStretch(*transform);
        EXPECT_LE(stretch, 1 + 2e-6);
        for (int n = 0; n < 10000; ++n) {
            const auto step = [&] { return double(random()) / 2147483648.0 - 1; };
            const double x = step(), y = step(), z = step();
            const openvdb::Vec3d v(x, y, z);
            const double length = transform->baseMap()->applyJacobian(v).length();
            ASSERT_LE(length, stretch * v.length() * (1 + 1e-14)) << v << ' ' << lean;
        }
    }
}

TEST(UniformVoxels, ARhombusOfEqualSidesIsNoCube)
{
    openvdb::Mat4d matrix = openvdb::Mat4d::identity();
    matrix.setRow(1, {0.6, 0.8, 0, 0}); // the y axis: as long as x, but leaning
    const auto rhombus = openvdb::math::Transform::createLinearTransform(matrix);
    EXPECT_TRUE(mentions(whyNot(*dotWith(rhombus)), "sheared"));
    EXPECT_FALSE(hasCubicVoxels(*rhombus));
}

TEST(UniformVoxels, AFrustumIsAnErrorThatSaysSo)
{
    const auto frustum = openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(10)), 0.5, 10.0, 1.0);
    EXPECT_TRUE(mentions(whyNot(*dotWith(frustum)), "frustum"));
    EXPECT_FALSE(hasCubicVoxels(*frustum));
}

TEST(UniformVoxels, InfinitiesAndNansInTheTransformAreErrors)
{
    using namespace openvdb::math;
    for (const double bad : {std::nan(""), kInfinity}) {
        EXPECT_TRUE(
            mentions(whyNot(*dotWith(mapped(MapBase::Ptr(new UniformScaleMap(bad))))), "'dot'"));
        const auto moved = Transform::createLinearTransform(1.0);
        moved->postTranslate({0, bad, 0});
        EXPECT_TRUE(mentions(whyNot(*dotWith(moved)), "'dot'"));
    }
}

TEST(UniformVoxels, AreTooFarAwayWhereDoublesAreFartherApart)
{
    for (const double voxel : {0.5, 2.0}) {
        for (const double voxels : {0x1p53, 0x1p54}) {
            const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
            transform->postTranslate({0, -voxels * voxel, 0});
            if (voxels == 0x1p53) EXPECT_NO_THROW(requireUniformVoxels(*dotWith(transform)));
            else EXPECT_TRUE(mentions(whyNot(*dotWith(transform)), "move it nearer"));
            EXPECT_TRUE(hasCubicVoxels(*transform)) << "wherever they are";
        }
    }
}

TEST(UniformVoxels, RotatedMirroredAndTinyCubesAreCubes)
{
    using namespace openvdb::math;
    const auto rotated = Transform::createLinearTransform(2e-5); // too small for OpenVDB's test
    rotated->postRotate(0.4, Z_AXIS);
    rotated->postRotate(1.4, X_AXIS);
    const auto large = Transform::createLinearTransform(1e8);
    large->postRotate(2.2, Y_AXIS);
    for (const Transform::Ptr& transform :
        {rotated, large, mapped(MapBase::Ptr(new ScaleMap({-0.5, 0.5, 0.5}))),
            mapped(MapBase::Ptr(new ScaleMap({1, 1 + 1e-8, 1}))),
            Transform::createLinearTransform(1e-4)}) {
        EXPECT_NO_THROW(requireUniformVoxels(*dotWith(transform))) << *transform;
        EXPECT_TRUE(hasCubicVoxels(*transform)) << *transform;
    }
}
