// SPDX-License-Identifier: Apache-2.0
/// @file TestVoxelRule.cc
/// @brief What the leafwise rule of a shape makes of full nodes and of the edge of its box.

#include <openvdb_spheretree/input/shapes/BallShape.h>

#include "support/GeneratedShapes.h"

#include <gtest/gtest.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// A cube of 4096^3 voxels and a bit more.
class FullCell : public detail::LeafwiseRule {
public:
    CoordBBox box() const override { return {Coord(-3, 0, 0), Coord(4095, 4095, 4095)}; }
    detail::Filling filling(const CoordBBox& cube) const override
    {
        if (cube.min()[0] >= 0) return detail::Filling::All;
        return cube.max()[1] < 8 && cube.max()[2] < 8  ? detail::Filling::Part
            : cube.min()[1] == 0 && cube.min()[2] == 0 ? detail::Filling::Part
                                                       : detail::Filling::None;
    }
    LeafMask leaf(const Coord&) const override
    {
        LeafMask full;
        full.fill(~uint64_t(0));
        return full;
    }
};

TEST(VoxelRule, FullNodesAreTilesAndLeavesAreClippedToTheBox)
{
    const auto tree = detail::treeOf(FullCell(), nullptr);
    EXPECT_EQ(tree->leafCount(), 1u);
    EXPECT_EQ(tree->getValueDepth(Coord(1, 2, 3)), 0); // a tile of the root
    EXPECT_EQ(tree->activeVoxelCount(), (uint64_t(1) << 36) + 3 * 64);
    EXPECT_TRUE(tree->isValueOn(Coord(-3, 7, 7)));
    EXPECT_FALSE(tree->isValueOn(Coord(-4, 7, 7)));
}

} // namespace
