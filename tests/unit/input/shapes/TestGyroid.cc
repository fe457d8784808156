// SPDX-License-Identifier: Apache-2.0
/// @file TestGyroid.cc
/// @brief The generated gyroid against its formula, voxel by voxel.

#include "support/GeneratedShapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// In doubles: how much nearer than 3 voxels the surface is, to first order.
double insideGyroid(const Coord& ijk)
{
    const double w = 2 * 3.14159265358979323846 / 64;
    const double x = w * ijk[0], y = w * ijk[1], z = w * ijk[2];
    using std::cos, std::sin;
    const double f = sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x);
    const openvdb::Vec3d gradient(cos(x) * cos(y) - sin(z) * sin(x),
        cos(y) * cos(z) - sin(x) * sin(y), cos(z) * cos(x) - sin(y) * sin(z));
    return 3 * w * gradient.length() - std::abs(f);
}

TEST(GeneratedGyroid, IsTheShellOfTheSurface)
{
    const auto grid = made(Shape::Gyroid, 150000);
    const CoordBBox box = boxOf(*grid);
    EXPECT_EQ(box.min(), Coord(0));
    EXPECT_TRUE(isNearCube(box.extents())) << box;
    EXPECT_GT(box.extents()[2], 64); // more than a period
    const auto accessor = grid->getConstAccessor();
    uint64_t count = 0, near = 0;
    for (auto ijk = box.begin(); ijk; ++ijk) {
        const double inside = insideGyroid(*ijk);
        const bool on = accessor.isValueOn(*ijk);
        count += on;
        ASSERT_EQ(accessor.getValue(*ijk), on);
        if (std::abs(inside) < 0.002) {
            ++near; // rounding decides
        } else {
            ASSERT_EQ(on, inside > 0) << *ijk;
        }
    }
    EXPECT_EQ(grid->activeVoxelCount(), count);
    EXPECT_LT(near, count / 50);
}

TEST(GeneratedGyroid, GoesOnFromPeriodToPeriod)
{
    const auto grid = made(Shape::Gyroid, 4000000); // 3 periods and a rest
    const auto accessor = grid->getConstAccessor();
    const CoordBBox box = boxOf(*grid);
    ASSERT_GT(box.max()[2], 3 * 64);
    for (auto ijk = box.begin(); ijk; ++ijk) {
        const Coord first = *ijk & 63;
        ASSERT_EQ(accessor.isValueOn(*ijk), accessor.isValueOn(first)) << *ijk;
    }
}

} // namespace
