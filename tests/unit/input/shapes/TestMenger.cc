// SPDX-License-Identifier: Apache-2.0
/// @file TestMenger.cc
/// @brief The generated Menger sponge against its definition, voxel by voxel.

#include "support/GeneratedShapes.h"

#include <gtest/gtest.h>

#include <utility>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// By definition: the middle of each face, and of the cube, at every size.
bool isOnMenger(const Coord& ijk)
{
    for (int size = 1; size < 3000; size *= 3) {
        int middle = 0;
        for (int axis = 0; axis < 3; ++axis) middle += ijk[axis] / size % 3 == 1;
        if (middle >= 2) return false;
    }
    return true;
}

TEST(GeneratedMenger, IsAWholeSpongeOfPowersOfTwenty)
{
    for (const auto& [voxels, side] : {std::pair{8000, 27}, std::pair{160000, 81}}) {
        const auto grid = made(Shape::Menger, voxels);
        EXPECT_EQ(grid->activeVoxelCount(), uint64_t(voxels));
        EXPECT_EQ(boxOf(*grid), CoordBBox(Coord(0), Coord(side - 1)));
        expectRule(*grid, boxOf(*grid), isOnMenger);
    }
}

TEST(GeneratedMenger, IsAPartOfALargerSpongeOtherwise)
{
    for (const int voxels : {1000, 30000, 1000000}) {
        const auto grid = made(Shape::Menger, voxels);
        const CoordBBox box = boxOf(*grid);
        EXPECT_EQ(box.min(), Coord(0));
        EXPECT_TRUE(isNearCube(box.extents())) << box;
        expectRule(*grid, box, isOnMenger);
    }
}

} // namespace
