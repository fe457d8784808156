// SPDX-License-Identifier: Apache-2.0
/// @file TestResample.cc
/// @brief Grids of other voxels: linear fields stay what they are, spheres stay spheres, masks lose
/// nothing; and grids of other units.

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/input/Resample.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include "support/CoreStages.h"
#include "support/Messages.h"
#include "support/ObjectGrids.h"

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Int32Grid;
using openvdb::Vec3d;
using openvdb::math::Transform;

Transform::Ptr stretched(const Vec3d& size)
{
    return std::make_shared<Transform>(
        openvdb::math::MapBase::Ptr(new openvdb::math::ScaleMap(size)));
}

template <typename Call>
std::string valueError(const Call& call)
{
    return messageOf<openvdb::ValueError>(call);
}

TEST(Resample, ALinearFieldIsTheSameInAnyVoxels)
{
    const auto grid = named<FloatGrid>("field", 0.0f);
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    const auto transform = stretched({0.5, 1, 2});
    transform->preShear(0.25, openvdb::math::X_AXIS, openvdb::math::Y_AXIS);
    transform->postRotate(0.3, openvdb::math::Z_AXIS);
    transform->postTranslate({3, 4, 5});
    grid->setTransform(transform);
    const auto field = [](const Vec3d& p) { return p[0] + 2 * p[1] - 0.5 * p[2]; };
    for (const Coord& ijk : CoordBBox(Coord(-9), Coord(12))) {
        grid->tree().setValue(ijk, float(field(transform->indexToWorld(ijk))));
    }
    for (const double voxel : {0.3, 1.0, 2.5}) {
        const auto result = openvdb::gridPtrCast<FloatGrid>(resampled(*grid, voxel));
        ASSERT_TRUE(result);
        EXPECT_NO_THROW(requireUniformVoxels(*result));
        EXPECT_NEAR(result->voxelSize()[0], voxel, 1e-12);
        EXPECT_EQ(result->getName(), "field");
        EXPECT_EQ(result->getGridClass(), openvdb::GRID_FOG_VOLUME);
        EXPECT_LT((result->indexToWorld(Coord(0)) - grid->indexToWorld(Coord(0))).length(), 1e-9);
        int inside = 0;
        for (const Coord& ijk : result->evalActiveVoxelBoundingBox()) {
            const Vec3d world = result->indexToWorld(ijk), at = grid->worldToIndex(world);
            const bool isInside = at[0] >= -9 && at[1] >= -9 && at[2] >= -9 && at[0] <= 12
                && at[1] <= 12 && at[2] <= 12;
            if (!isInside) continue;
            ++inside;
            ASSERT_NEAR(result->tree().getValue(ijk), field(world), 1e-4) << ijk << voxel;
            ASSERT_TRUE(result->tree().isValueOn(ijk));
        }
        EXPECT_NEAR(
            inside, 21 * 21 * 21 / std::pow(voxel, 3), 0.25 * 9261 / std::pow(voxel, 3) + 60);
    }
}

/// Interpolation reaches up to, not including, the next voxels, on either side alike.
TEST(Resample, AVoxelAloneIsATentToEitherSide)
{
    for (const Coord& at : {Coord(0), Coord(7), Coord(-1), Coord(3)}) {
        const auto grid = named<openvdb::DoubleGrid>("dot", 0);
        grid->tree().setValueOn(at, 8.0);
        const auto result = openvdb::gridPtrCast<openvdb::DoubleGrid>(resampled(*grid, 0.25));
        ASSERT_TRUE(result);
        EXPECT_EQ(result->activeVoxelCount(), 7u * 7 * 7);
        for (int step = -4; step <= 4; ++step) {
            const Coord ijk(4 * at[0] + step, 4 * at[1], 4 * at[2]);
            EXPECT_EQ(result->tree().getValue(ijk), 8.0 - 2 * std::abs(step)) << at << step;
        }
    }
}

/// Voxels of 0.1, and others that are moved, are not centered anywhere but for rounding.
TEST(Resample, ToItsOwnVoxelsAGridStaysAsItIs)
{
    for (const double voxel : {0.1, 0.3, 1.0, 1.0 / 3}) {
        const auto grid = named<FloatGrid>("fog", 0.0f);
        grid->setGridClass(openvdb::GRID_FOG_VOLUME);
        const auto transform = Transform::createLinearTransform(voxel);
        transform->postTranslate({0.3, 0.7, 0.1});
        grid->setTransform(transform);
        for (const Coord& ijk : CoordBBox(Coord(-9, 40, 1000), Coord(-2, 47, 1007))) {
            grid->tree().setValue(ijk, float(ijk[0] * 3 + ijk[1] + ijk[2] * 7));
        }
        const auto result = openvdb::gridPtrCast<FloatGrid>(resampled(*grid, voxel));
        EXPECT_EQ(result->activeVoxelCount(), 512u) << voxel;
        for (auto value = result->cbeginValueOn(); value; ++value) {
            const Coord there =
                Coord::round(grid->worldToIndex(result->indexToWorld(value.getCoord())));
            ASSERT_EQ(*value, grid->tree().getValue(there)) << voxel;
        }
    }
}

/// 0.3 / 0.1 is a little less than 3 in doubles: what lies beside a center has no part in it.
TEST(Resample, OntoCentersTheNeighboursTakeNoPart)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    grid->setTransform(Transform::createLinearTransform(0.1));
    for (const Coord& ijk : CoordBBox(Coord(0, 0, -50), Coord(0, 0, 50))) {
        const bool isCenter = ijk[2] % 3 == 0;
        if (isCenter && ijk[2] % 2 == 0) grid->tree().setValueOff(ijk, float(ijk[2]));
        else grid->tree().setValue(ijk, isCenter ? float(ijk[2]) : std::nanf(""));
    }
    const auto result = openvdb::gridPtrCast<FloatGrid>(resampled(*grid, 0.3));
    for (int k = -16; k <= 16; ++k) {
        EXPECT_EQ(result->tree().getValue(Coord(0, 0, k)), float(3 * k)) << k;
        EXPECT_EQ(result->tree().isValueOn(Coord(0, 0, k)), k % 2 != 0) << k;
    }
}

TEST(Resample, IntegersAreRoundedToTheNearest)
{
    const auto grid = named<Int32Grid>("scan", 0);
    grid->tree().setValueOn(Coord(0), 10);
    grid->tree().setValueOn(Coord(1, 0, 0), -1);
    const auto result = openvdb::gridPtrCast<Int32Grid>(resampled(*grid, 0.25));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->tree().getValue(Coord(1, 0, 0)), 7);  // 7.25
    EXPECT_EQ(result->tree().getValue(Coord(2, 0, 0)), 5);  // 4.5, away from 0
    EXPECT_EQ(result->tree().getValue(Coord(5, 0, 0)), -1); // -0.75
}

TEST(Resample, TheLargestIntegerStaysIt)
{
    const int64_t most = std::numeric_limits<int64_t>::max();
    const auto grid = named<openvdb::Int64Grid>("labels", most);
    grid->tree().setValueOn(Coord(0), most);
    const auto result = openvdb::gridPtrCast<openvdb::Int64Grid>(resampled(*grid, 0.5));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->tree().getValue(Coord(0)), most);
    EXPECT_EQ(result->tree().getValue(Coord(1, 0, 0)), most);
}

TEST(Resample, LabelsAreThoseOfTheNearestVoxel)
{
    const auto grid = named<openvdb::Int64Grid>("labels", 0);
    grid->setTransform(stretched({1, 1, 2}));
    grid->tree().setValueOn(Coord(0), 3);
    grid->tree().setValueOn(Coord(0, 0, 1), 5);
    const auto result =
        openvdb::gridPtrCast<openvdb::Int64Grid>(resampled(*grid, 0.5, Sampling::Nearest));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->activeVoxelCount(), 2u * 2 * 8);
    for (auto value = result->cbeginValueOn(); value; ++value) {
        const bool isFirst = value.getCoord()[2] < 2;
        EXPECT_EQ(*value, isFirst ? 3 : 5) << value.getCoord();
    }
    const auto ball =
        openvdb::tools::createLevelSetSphere<FloatGrid>(10.0f, openvdb::Vec3f(0), 0.5f);
    EXPECT_TRUE(
        mentions(valueError([&] { resampled(*ball, 1, Sampling::Nearest); }), "leave out nearest"));
}

TEST(Resample, AMaskTakesTheVoxelThatHoldsThePlace)
{
    const auto transform = stretched({1, 1, 3});
    const auto mask = openvdb::MaskGrid::create();
    mask->setTransform(transform);
    mask->tree().setValueOn(Coord(0, 0, 0));
    mask->tree().setValueOn(Coord(8, 0, 1));
    mask->tree().addTile(1, Coord(16, 16, 16), true, true);
    const auto result = openvdb::gridPtrCast<openvdb::MaskGrid>(resampled(*mask, 1));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->activeVoxelCount(), 3u + 3 + 512 * 3);
    for (const Coord& ijk : {Coord(0, 0, -1), Coord(0, 0, 1), Coord(8, 0, 2), Coord(8, 0, 4)}) {
        EXPECT_TRUE(result->tree().isValueOn(ijk)) << ijk;
    }
    const auto bits = named<BoolGrid>("bits", false);
    bits->setTransform(transform);
    bits->tree().setValueOn(Coord(0), false);
    bits->tree().setValueOff(Coord(4, 4, 4), true);
    const auto same = openvdb::gridPtrCast<BoolGrid>(resampled(*bits, 1));
    ASSERT_TRUE(same);
    EXPECT_EQ(same->activeVoxelCount(), 3u);
    EXPECT_FALSE(same->tree().getValue(Coord(0)));
    EXPECT_TRUE(same->tree().getValue(Coord(4, 4, 12)));
}

TEST(Resample, ALevelSetIsMadeAnewOfDistances)
{
    // A ball of radius 10 in voxels of 1 x 1 x 2.
    const auto grid = named<FloatGrid>("ball", 6.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->setTransform(stretched({1, 1, 2}));
    for (const Coord& ijk : CoordBBox(Coord(-17, -17, -9), Coord(17, 17, 9))) {
        const double distance = grid->indexToWorld(ijk).length() - 10;
        if (std::abs(distance) < 6) grid->tree().setValueOn(ijk, float(distance));
        else grid->tree().setValueOff(ijk, distance < 0 ? -6.0f : 6.0f);
    }
    const auto result = openvdb::gridPtrCast<FloatGrid>(resampled(*grid, 0.5));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->getGridClass(), openvdb::GRID_LEVEL_SET);
    EXPECT_EQ(result->getName(), "ball");
    EXPECT_NEAR(result->background(), 1.5, 1e-6);
    for (auto value = result->cbeginValueOn(); value; ++value) {
        EXPECT_NEAR(*value, result->indexToWorld(value.getCoord()).length() - 10, 0.25);
    }
    const double volume = double(objectOf(*result)->activeVoxelCount()) / 8;
    EXPECT_NEAR(volume, 4.18879 * 1000, 120); // OpenVDB's surface is one of flat pieces
}

TEST(Resample, WhatCannotBeIsRefusedWithTheNumber)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->tree().addTile(2, Coord(0), 1.0f, true);
    EXPECT_TRUE(mentions(valueError([&] { resampled(*grid, 0); }), "above 0"));
    EXPECT_TRUE(mentions(valueError([&] { resampled(*grid, std::nan("")); }), "above 0"));
    const std::string many = valueError([&] { resampled(*grid, 1e-4); });
    EXPECT_TRUE(mentions(many, "'fog' has 2.1e+18 voxels of size 0.0001"));
    EXPECT_TRUE(mentions(many, "larger voxel"));
    const auto dot = named<FloatGrid>("dot", 0.0f);
    dot->tree().setValueOn(Coord(1 << 30, 0, 0), 1.0f);
    EXPECT_TRUE(mentions(valueError([&] { resampled(*dot, 0.9); }), "beyond voxel 2^30"));
    const auto ball =
        openvdb::tools::createLevelSetSphere<FloatGrid>(10.0f, openvdb::Vec3f(0), 0.5f);
    EXPECT_TRUE(mentions(valueError([&] { resampled(*ball, 2e-5); }), "voxels of size"));
    EXPECT_TRUE(mentions(valueError([&] { resampled(*ball, 1e-9); }), "a voxel of size 1e-09"));
    const auto vectors = named<openvdb::Vec3SGrid>("v", openvdb::Vec3s(0));
    EXPECT_TRUE(
        mentions(messageOf<openvdb::TypeError>([&] { resampled(*vectors, 1); }), "'v' is of type"));
    const auto frustum = named<FloatGrid>("cone", 0.0f);
    frustum->setTransform(
        Transform::createFrustumTransform(openvdb::BBoxd(Vec3d(0), Vec3d(10)), 0.5, 10, 1.0));
    EXPECT_TRUE(mentions(valueError([&] { resampled(*frustum, 1); }), "frustum"));
}

/// NaN is equal to nothing: tiles of such a background were taken for values, of gigabytes.
TEST(Resample, ABackgroundThatIsNoNumberTakesNoRoom)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto grid = named<FloatGrid>("o", nan);
    grid->tree().fill(CoordBBox(Coord(0), Coord(7)), 1.0f);
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    const auto result = openvdb::gridPtrCast<FloatGrid>(resampled(*grid, 0.5));
    ASSERT_TRUE(result);
    EXPECT_EQ(result->tree().getValue(Coord(7)), 1.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    EXPECT_TRUE(mentions(
        valueError([&] { resampled(*grid, 0.5); }), "its background is nan, which is no distance"));
    EXPECT_TRUE(mentions(valueError([&] { objectOf(*grid); }), "its background is nan, where"));
}

TEST(Resample, StopsWhenInterrupted)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->tree().fill(CoordBBox(Coord(0), Coord(20)), 1.0f);
    for (int after = 0; after < 3; ++after) {
        StopAfter interrupter(after);
        EXPECT_THROW(resampled(*grid, 0.5, Sampling::Linear, &interrupter), Interrupted) << after;
    }
    const auto ball =
        openvdb::tools::createLevelSetSphere<FloatGrid>(10.0f, openvdb::Vec3f(0), 0.5f);
    StopAfter interrupter(1);
    EXPECT_THROW(resampled(*ball, 0.4, Sampling::Linear, &interrupter), Interrupted);
}

TEST(Resample, TheShortestEdgeIsThatOfAVoxel)
{
    const auto grid = named<FloatGrid>("scan", 0.0f);
    grid->setTransform(stretched({0.5, 0.25, 1}));
    EXPECT_EQ(shortestVoxelEdge(*grid), 0.25);
}

TEST(ScaleGrid, DistancesOfALevelSetGrowWithItsVoxels)
{
    const auto ball =
        openvdb::tools::createLevelSetSphere<FloatGrid>(10.0f, openvdb::Vec3f(0), 0.5f);
    const auto other = ball->copy(); // shares the tree
    const auto expected =
        openvdb::tools::createLevelSetSphere<FloatGrid>(40.0f, openvdb::Vec3f(0), 2.0f);
    scaleGrid(*ball, 4);
    EXPECT_EQ(ball->voxelSize()[0], 2.0);
    EXPECT_EQ(ball->background(), expected->background());
    for (auto value = expected->cbeginValueAll(); value; ++value) {
        EXPECT_NEAR(ball->tree().getValue(value.getCoord()), *value, 1e-5);
    }
    const auto untouched = openvdb::gridPtrCast<FloatGrid>(other);
    EXPECT_EQ(untouched->background(), 1.5f);
    EXPECT_EQ(untouched->tree().getValue(Coord(0)), -1.5f);
}

TEST(ScaleGrid, OtherValuesStay)
{
    const auto fog = named<FloatGrid>("fog", 0.0f);
    fog->tree().setValueOn(Coord(1, 2, 3), 5.0f);
    fog->setTransform(stretched({1, 2, 3}));
    scaleGrid(*fog, 0.001);
    EXPECT_EQ(fog->tree().getValue(Coord(1, 2, 3)), 5.0f);
    EXPECT_LT((fog->indexToWorld(Coord(1)) - Vec3d(0.001, 0.002, 0.003)).length(), 1e-15);
    for (const double factor :
        {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity(), 1e-30}) {
        EXPECT_TRUE(mentions(valueError([&] { scaleGrid(*fog, factor); }), "another scale"))
            << factor;
    }
}

} // namespace
