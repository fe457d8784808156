// SPDX-License-Identifier: Apache-2.0
/// @file TestMasks.cc
/// @brief Tiles of a tree, copies of its topology, and what its nodes take, against OpenVDB's own.

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>
#include <openvdb_spheretree/voxel/NodeBytes.h>
#include <openvdb_spheretree/voxel/TopologyCopy.h>

#include "support/CoreStages.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskTree;

/// Tiles of every size, on and off, and voxels, on both sides of 0 along every axis.
MaskTree::Ptr randomTree(uint32_t seed)
{
    std::mt19937 random(seed);
    auto tree = std::make_shared<MaskTree>(false);
    for (int i = 0; i < 60; ++i) {
        const auto at = [&] { return int(random() % 16384) - 8192; };
        const Coord ijk(at(), at(), at());
        const bool isOn = random() % 4 != 0;
        tree->addTile(random() % 4, ijk, isOn, isOn);
        if (i % 2) tree->setValueOn(ijk.offsetBy(1000));
    }
    return tree;
}

std::vector<CoordBBox> tilesOf(const MaskTree& tree)
{
    std::vector<CoordBBox> tiles;
    detail::forEachTile(tree, [&](const CoordBBox& box) { tiles.push_back(box); });
    return tiles;
}

TEST(Masks, TilesComeInTheOrderOfOpenVdbsIterators)
{
    for (uint32_t seed = 1; seed < 40; ++seed) {
        const MaskTree::Ptr tree = randomTree(seed);
        std::vector<CoordBBox> expected;
        auto tile = tree->cbeginValueOn();
        tile.setMaxDepth(MaskTree::ValueOnCIter::LEAF_DEPTH - 1);
        for (; tile; ++tile) {
            CoordBBox box;
            tile.getBoundingBox(box);
            expected.push_back(box);
        }
        ASSERT_GT(expected.size(), 10u);
        EXPECT_EQ(tilesOf(*tree), expected) << "seed " << seed;
    }
}

TEST(Masks, ACopyOfATopologyIsThatOfOpenVdb)
{
    for (uint32_t seed = 1; seed < 20; ++seed) {
        const MaskTree::Ptr tree = randomTree(seed);
        const openvdb::BoolTree expected(*tree, false, true, openvdb::TopologyCopy());
        const auto copy = detail::copyTopology<openvdb::BoolTree>(*tree, nullptr);
        EXPECT_TRUE(copy->hasSameTopology(expected)) << "seed " << seed;
        EXPECT_EQ(copy->root().getTableSize(), expected.root().getTableSize());
        for (auto value = copy->cbeginValueAll(); value; ++value) {
            ASSERT_EQ(*value, value.isValueOn()) << value.getCoord();
        }
    }
}

TEST(Masks, ACopyOfATopologyCanBeInterrupted)
{
    spheretree_test::StopAfter now(0);
    EXPECT_THROW(detail::copyTopology<openvdb::BoolTree>(*randomTree(1), &now), Interrupted);
}

TEST(Masks, NodesTakeWhatOpenVdbCounts)
{
    const MaskTree::Ptr tree = randomTree(5);
    const double counted = double(tree->memUsage());
    EXPECT_NEAR(detail::nodeBytes(*tree), counted, 0.01 * counted);
}

} // namespace
