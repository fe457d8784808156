// SPDX-License-Identifier: Apache-2.0
/// @file TestBoxSides.cc
/// @brief Sides and voxels of boxes, at the ends of coordinates and of none.

#include <openvdb_spheretree/voxel/BoxSides.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb_spheretree::detail::forEachVoxelOf;
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

TEST(BoxVoxels, AreThoseOfOpenVdbInItsOrder)
{
    const CoordBBox box(Coord(-2, 3, -1), Coord(1, 5, 0));
    std::vector<Coord> expected, found;
    for (auto ijk = box.begin(); ijk; ++ijk) expected.push_back(*ijk);
    forEachVoxelOf(box, [&](const Coord& ijk) { found.push_back(ijk); });
    EXPECT_EQ(found, expected);
    forEachVoxelOf(CoordBBox(), [](const Coord& ijk) { ADD_FAILURE() << ijk; });
}

TEST(BoxVoxels, EndAtTheLastCoordinate)
{
    int count = 0;
    forEachVoxelOf(CoordBBox(Coord(INT32_MAX - 1), Coord(INT32_MAX)), [&](const Coord& ijk) {
        EXPECT_GE(ijk, Coord(INT32_MAX - 1));
        ASSERT_LE(++count, 8);
    });
    EXPECT_EQ(count, 8);
}

} // namespace
