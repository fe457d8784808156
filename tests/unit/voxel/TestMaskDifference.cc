// SPDX-License-Identifier: Apache-2.0
/// @file TestMaskDifference.cc
/// @brief What one mask has and another has not, from nodes and tiles of every size, against
/// OpenVDB's own difference.

#include <openvdb_spheretree/voxel/MaskDifference.h>

#include "support/RandomObjects.h"

#include <gtest/gtest.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::MaskTree;

/// The cubes as a tree; they have no voxel twice.
MaskTree unionOf(const detail::MaskDifference& difference)
{
    MaskTree tree(false);
    int64_t voxels = 0;
    for (const detail::VoxelCube& cube : difference.cubes) {
        voxels += cube.voxels();
        if (cube.size > kLeafDim) {
            tree.sparseFill(CoordBBox::createCube(cube.origin, cube.size), true);
            continue;
        }
        for (uint32_t n = 0; n < kLeafVoxels; ++n) {
            if (!cube.mask.isOn(n)) continue;
            tree.setValueOn(cube.origin.offsetBy(int(n >> 6), int(n >> 3 & 7), int(n & 7)));
        }
    }
    EXPECT_EQ(voxels, difference.voxels);
    EXPECT_EQ(voxels, detail::countVoxels(tree)) << "cubes overlap";
    return tree;
}

testing::AssertionResult isSame(const MaskTree& a, const MaskTree& b)
{
    MaskTree both(a);
    both.topologyIntersection(b);
    const auto count = detail::countVoxels(both);
    if (count == detail::countVoxels(a) && count == detail::countVoxels(b)) {
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure()
        << detail::countVoxels(a) << " voxels, " << detail::countVoxels(b) << " expected, " << count
        << " in both";
}

/// A voxel, or a tile of 8, 128 or 4096, at the origin or at the end of the 4096 from there.
MaskTree maskOfSize(int size, bool atEnd)
{
    MaskTree mask(false);
    const Coord origin(atEnd ? 4096 - size : 0);
    const int level = size == 1 ? 0 : size == 8 ? 1 : size == 128 ? 2 : 3;
    mask.addTile(openvdb::Index(level), origin, true, true);
    return mask;
}

TEST(MaskDifference, IsThatOfOpenVdbForNodesAndTilesOfEverySize)
{
    for (const int a : {1, 8, 128, 4096}) {
        for (const int b : {1, 8, 128, 4096}) {
            for (const bool atEnd : {false, true}) {
                SCOPED_TRACE(std::to_string(a) + " \\ " + std::to_string(b));
                MaskTree first = maskOfSize(a, atEnd);
                if (atEnd) first.setValueOn(Coord(-1, 5, 9)); // and something apart
                const MaskTree second = maskOfSize(b, atEnd);
                MaskTree expected(first);
                expected.topologyDifference(second);
                const auto difference = detail::maskDifference(first, second, nullptr);
                EXPECT_TRUE(isSame(unionOf(difference), expected));
            }
        }
    }
}

TEST(MaskDifference, OfANodeAndATileOverAllOfItIsEmpty)
{
    MaskTree node(false), tile(false);
    node.setValueOn(Coord(130, 7, 200));
    node.addTile(1, Coord(136, 0, 128), true, true);
    tile.addTile(2, Coord(128, 0, 128), true, true);
    EXPECT_EQ(detail::maskDifference(node, tile, nullptr).voxels, 0);
    EXPECT_EQ(detail::maskDifference(tile, node, nullptr).voxels, 128 * 128 * 128 - 513);
}

TEST(MaskDifference, CutsATileUpOnlyWhereTheOtherMaskHasNodes)
{
    MaskTree tile(false), voxel(false);
    tile.addTile(3, Coord(0), true, true);
    EXPECT_EQ(detail::maskDifference(tile, voxel, nullptr).cubes.size(), 1u);
    voxel.setValueOn(Coord(300, 400, 500));
    const auto rest = detail::maskDifference(tile, voxel, nullptr);
    EXPECT_EQ(rest.voxels, (int64_t(1) << 36) - 1);
    EXPECT_EQ(rest.cubes.size(), 32768u - 1 + 4096); // 128 a side, and 8 where the voxel is
}

} // namespace
