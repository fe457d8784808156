// SPDX-License-Identifier: Apache-2.0
/// @file TestVoxelMoments.cc
/// @brief Sums over voxels, against one voxel after the other.

#include <openvdb_spheretree/measure/VoxelMoments.h>

#include <openvdb_spheretree/base/Interrupted.h>

#include "support/RandomObjects.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <limits>

namespace {

using namespace openvdb_spheretree;
using detail::momentsOf;
using detail::momentsOfCube;
using detail::VoxelMoments;
using openvdb::BoolTree;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskTree;

void expectSame(const VoxelMoments& a, const VoxelMoments& b)
{
    EXPECT_TRUE(a.count == b.count);
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(a.first[i] == b.first[i]) << "axis " << i;
    for (int i = 0; i < 6; ++i) EXPECT_TRUE(a.second[i] == b.second[i]) << "product " << i;
}

void add(VoxelMoments& moments, const Coord& ijk)
{
    using Integer = VoxelMoments::Integer;
    const Integer x = ijk[0], y = ijk[1], z = ijk[2];
    moments += {1, {x, y, z}, {x * x, y * y, z * z, y * z, x * z, x * y}};
}

TEST(VoxelMoments, AreThoseOfVoxelsOneByOne)
{
    for (uint32_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        MaskTree mask;
        BoolTree tree(false);
        VoxelMoments expected;
        for (const Coord& ijk : spheretree_test::randomObject(seed).voxels) {
            mask.setValueOn(ijk);
            tree.setValueOn(ijk, seed % 2 == 0); // active voxels, whatever their values
            add(expected, ijk);
        }
        expectSame(momentsOf(mask), expected);
        expectSame(momentsOf(tree), expected);
    }
}

TEST(VoxelMoments, OfEveryRowOfALeafAreThoseOfItsVoxels)
{
    for (uint64_t row = 0; row < 256; ++row) {
        LeafMask mask{};
        mask[5] = row << 24;
        VoxelMoments expected;
        for (int z = 0; z < 8; ++z) {
            if (row >> z & 1) add(expected, Coord(5, 3, z));
        }
        expectSame(momentsOf(mask), expected);
    }
}

TEST(VoxelMoments, OfCubesAreThoseOfTheirVoxels)
{
    for (const int side : {1, 2, 7, 8, 16}) {
        VoxelMoments expected;
        for (auto ijk = CoordBBox::createCube(Coord(0), side).begin(); ijk; ++ijk) {
            add(expected, *ijk);
        }
        expectSame(momentsOfCube(side), expected);
    }
}

TEST(VoxelMoments, OfTilesAreThoseOfTheirLeaves)
{
    MaskTree tiles, leaves;
    tiles.addTile(1, Coord(-8, 16, 800), true, true);
    tiles.addTile(2, Coord(256, -128, 0), true, true);
    leaves.topologyUnion(tiles);
    leaves.voxelizeActiveTiles();
    ASSERT_EQ(tiles.leafCount(), 0u);
    ASSERT_EQ(leaves.leafCount(), 4097u);
    expectSame(momentsOf(tiles), momentsOf(leaves));
}

TEST(VoxelMoments, OfTheLargestTilesAtTheEndsOfSpaceDoNotOverflow)
{
    MaskTree tree;
    const int32_t end = std::numeric_limits<int32_t>::max() - 4095;
    tree.addTile(3, Coord(end), true, true);
    tree.addTile(3, Coord(-end), true, true);
    const VoxelMoments moments = momentsOf(tree);
    EXPECT_TRUE(moments.count == (VoxelMoments::Integer(1) << 37));
    const long double second = (long double)(moments.second[0]);
    EXPECT_NEAR(double(second / (0x1p37L * 0x1p62L)), 1, 1e-5);
}

TEST(VoxelMoments, AreTheSameForAnyNumberOfThreads)
{
    MaskTree tree;
    for (int i = 0; i < 3000; ++i) tree.setValueOn(Coord(17 * i % 1021, 31 * i % 997, 7 * i));
    const VoxelMoments many = momentsOf(tree);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    expectSame(momentsOf(tree), many);
}

TEST(VoxelMoments, CanBeInterrupted)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    MaskTree tree;
    tree.setValueOn(Coord(1));
    EXPECT_THROW(momentsOf(tree, &stop), Interrupted);
}

} // namespace
