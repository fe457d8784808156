// SPDX-License-Identifier: Apache-2.0
/// @file TestBoxSides.cc
/// @brief Sides of boxes of voxels, at the ends of coordinates and of none.

#include <openvdb_spheretree/voxel/BoxSides.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb_spheretree::detail::longestSideOf;
using openvdb_spheretree::detail::sidesOf;
using Sides = std::array<int64_t, 3>;

TEST(BoxSides, AreThoseOfOpenVdbWhereTheseFit32Bits)
{
    const CoordBBox box(Coord(-3, 4, 7), Coord(5, 4, 9));
    EXPECT_EQ(sidesOf(box), (Sides{box.dim()[0], box.dim()[1], box.dim()[2]}));
    EXPECT_EQ(longestSideOf(box), 9);
}

TEST(BoxSides, AreRightFromTheFirstCoordinateToTheLast)
{
    const CoordBBox box(Coord(INT32_MIN, -1, 0), Coord(INT32_MAX, INT32_MAX, 0));
    EXPECT_EQ(sidesOf(box), (Sides{int64_t(1) << 32, (int64_t(1) << 31) + 1, 1}));
    EXPECT_EQ(longestSideOf(box), int64_t(1) << 32);
}

TEST(BoxSides, OfAnEmptyBoxAreNone)
{
    EXPECT_EQ(sidesOf(CoordBBox()), Sides());
    EXPECT_EQ(sidesOf(CoordBBox(Coord(0), Coord(4, -1, 4))), Sides());
    EXPECT_EQ(longestSideOf(CoordBBox()), 0);
}

} // namespace
