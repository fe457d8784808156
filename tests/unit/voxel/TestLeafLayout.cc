// SPDX-License-Identifier: Apache-2.0
/// @file TestLeafLayout.cc
/// @brief Leaves, their masks and runs, for trees of voxels and tiles.

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/base/Memory.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::MaskTree;

constexpr Axis kAxes[] = {Axis::X, Axis::Y, Axis::Z};

Voxels voxelsOf(const LeafLayout& layout)
{
    Voxels voxels;
    forEachVoxel(layout, [&](uint32_t, uint32_t, const Coord& voxel) { voxels.push_back(voxel); });
    std::sort(voxels.begin(), voxels.end());
    return voxels;
}

/// The leaves' origins, run by run.
std::vector<Voxels> runsOf(const LeafLayout& layout, Axis axis)
{
    std::vector<Voxels> runs;
    for (uint32_t i = 0; i < layout.runCount(axis); ++i) {
        const LeafLayout::Run run = layout.run(axis, i);
        runs.emplace_back();
        for (uint32_t k = 0; k < run.count; ++k) {
            runs.back().push_back(layout.origin(run.leaves[k]));
        }
    }
    return runs;
}

TEST(LeafLayout, OffsetsAreThoseOfOpenVdbsLeafNodes)
{
    using Leaf = MaskTree::LeafNodeType;
    for (const Coord& ijk : voxelsOfBox(CoordBBox(Coord(-9, -9, -9), Coord(9, 9, 9)))) {
        ASSERT_EQ(leafIndex(ijk), Leaf::coordToOffset(ijk)) << ijk;
    }
    EXPECT_EQ(leafIndex(Coord(-1, -1, -1)), 511u);
    EXPECT_EQ(leafIndex(Coord(1, 2, 3)), 64u + 16u + 3u);
}

TEST(LeafLayout, VoxelIsTheInverseOfTheOffset)
{
    const LeafLayout layout(*maskOf(Voxels{Coord(-3, 130, -4097)}));
    ASSERT_EQ(layout.leafCount(), 1u);
    EXPECT_EQ(layout.origin(0), Coord(-8, 128, -4104));
    for (uint32_t offset = 0; offset < 512; ++offset) {
        const Coord voxel = layout.voxel(0, offset);
        ASSERT_EQ(leafIndex(voxel), offset);
        ASSERT_EQ(voxel & ~7, layout.origin(0));
    }
}

TEST(LeafLayout, AnEmptyTreeHasNoLeavesAndNoRuns)
{
    const LeafLayout layout((MaskTree(false)));
    EXPECT_EQ(layout.leafCount(), 0u);
    EXPECT_EQ(layout.voxelCount(), 0);
    for (Axis axis : kAxes) EXPECT_EQ(layout.runCount(axis), 0u);
    EXPECT_FALSE(layout.findLeaf(Coord(0, 0, 0)));
}

TEST(LeafLayout, LeavesWithoutVoxelsAreLeftOut)
{
    const auto tree = maskOf(Voxels{Coord(100, 0, 0)});
    tree->touchLeaf(Coord(0, 0, 0));
    const LeafLayout layout(*tree);
    EXPECT_EQ(layout.leafCount(), 1u);
    EXPECT_FALSE(layout.findLeaf(Coord(0, 0, 0)));
}

TEST(LeafLayout, HoldsTheVoxelsOfRandomObjectsInTheOrderOfLeaves)
{
    for (uint32_t seed = 0; seed < 110; ++seed) {
        const RandomObject object = randomObject(seed);
        const auto tree = maskOf(object.voxels);
        if (seed % 2) tree->prune();
        const LeafLayout layout(*tree);
        ASSERT_EQ(layout.voxelCount(), int64_t(object.voxels.size())) << object.name;
        ASSERT_EQ(voxelsOf(layout), object.voxels) << object.name;
        for (uint32_t leaf = 1; leaf < layout.leafCount(); ++leaf) {
            ASSERT_TRUE(layout.origin(leaf - 1) < layout.origin(leaf)) << object.name;
        }
    }
}

TEST(LeafLayout, KnowsTheSlabOfEveryLeaf)
{
    for (uint32_t seed = 0; seed < 11; ++seed) {
        const LeafLayout layout(*maskOf(randomObject(seed).voxels));
        for (uint32_t slab = 0; slab < layout.slabCount(); ++slab) {
            const LeafLayout::Slab leaves = layout.slab(slab);
            ASSERT_LT(leaves.begin, leaves.end);
            for (uint32_t k = leaves.begin; k < leaves.end; ++k) ASSERT_EQ(layout.slabOf(k), slab);
        }
    }
}

TEST(LeafLayout, RunsHoldEveryLeafOnceAndEndAtGaps)
{
    for (uint32_t seed = 0; seed < 55; ++seed) {
        Voxels sparse = randomObject(seed).voxels;
        for (Coord& voxel : sparse) voxel = Coord(voxel[0] * 3, voxel[1] * 3, voxel[2] * 3);
        const LeafLayout layout(*maskOf(sparse));
        for (Axis axis : kAxes) {
            Coord step(0, 0, 0);
            step[int(axis)] = 8;
            std::set<Coord> seen;
            for (const Voxels& run : runsOf(layout, axis)) {
                ASSERT_FALSE(layout.findLeaf(run.front() - step)) << "a run starts too late";
                ASSERT_FALSE(layout.findLeaf(run.back() + step)) << "a run ends too early";
                for (std::size_t i = 0; i < run.size(); ++i) {
                    ASSERT_TRUE(seen.insert(run[i]).second) << "leaf twice";
                    ASSERT_EQ(run[i], i == 0 ? run[0] : run[i - 1] + step);
                }
            }
            ASSERT_EQ(seen.size(), layout.leafCount());
        }
    }
}

TEST(LeafLayout, ARowOfLeavesIsOneRunAlongItAndManyAcross)
{
    const LeafLayout layout(
        *maskOf(Voxels{Coord(-1, 0, 0), Coord(0, 0, 0), Coord(8, 0, 0), Coord(24, 0, 0)}));
    const std::vector<Voxels> alongX{
        {Coord(-8, 0, 0), Coord(0, 0, 0), Coord(8, 0, 0)}, {Coord(24, 0, 0)}};
    EXPECT_EQ(runsOf(layout, Axis::X), alongX);
    EXPECT_EQ(layout.runCount(Axis::Y), 4u);
    EXPECT_EQ(layout.runCount(Axis::Z), 4u);
}

TEST(LeafLayout, NeighbourWalksAlongTheRun)
{
    const CoordBBox box(Coord(-20, -20, -20), Coord(20, 20, 20));
    const LeafLayout layout(*maskOf(box));
    for (Axis axis : kAxes) {
        for (int steps : {-2, -1, 0, 1, 2}) {
            Coord there(0, 0, 0);
            there[int(axis)] = 8 * steps;
            const uint32_t middle = *layout.findLeaf(Coord(0, 0, 0));
            EXPECT_EQ(layout.origin(layout.neighbour(middle, axis, steps)), there);
        }
    }
}

TEST(LeafLayout, FindsTheLeafOfAVoxelOnOrOff)
{
    const LeafLayout layout(*maskOf(Voxels{Coord(-1, -1, -1), Coord(9, 0, 0), Coord(9, 0, 4096)}));
    EXPECT_EQ(layout.findLeaf(Coord(-1, -1, -1)), std::optional<uint32_t>(0));
    EXPECT_EQ(layout.findLeaf(Coord(-8, -2, -8)), std::optional<uint32_t>(0));
    EXPECT_EQ(layout.findLeaf(Coord(15, 7, 7)), std::optional<uint32_t>(1));
    EXPECT_EQ(layout.findLeaf(Coord(8, 0, 4100)), std::optional<uint32_t>(2));
    EXPECT_FALSE(layout.findLeaf(Coord(0, 0, 0)));
    EXPECT_FALSE(layout.findLeaf(Coord(9, 0, 4104)));
    EXPECT_FALSE(layout.findLeaf(Coord(-9, -1, -1)));
}

TEST(LeafLayout, ATileIsTheLeavesItStandsFor)
{
    struct {
        int size;
        openvdb::Index level;
    } const tiles[] = {{8, 1}, {128, 2}};
    for (const auto& tile : tiles) {
        const CoordBBox box = CoordBBox::createCube(Coord(-tile.size, 0, tile.size), tile.size);
        MaskTree tree(false);
        tree.addTile(tile.level, box.min(), true, true);
        ASSERT_EQ(tree.leafCount(), 0u);
        const LeafLayout layout(tree);
        EXPECT_EQ(layout.leafCount(), uint32_t(tile.size / 8 * tile.size / 8 * tile.size / 8));
        EXPECT_EQ(layout.voxelCount(), int64_t(tile.size) * tile.size * tile.size);
        EXPECT_EQ(layout.origin(0), box.min());
        EXPECT_EQ(layout.origin(layout.leafCount() - 1), box.max() & ~7);
        EXPECT_EQ(runsOf(layout, Axis::Y)[0].size(), std::size_t(tile.size / 8));

        tree.voxelizeActiveTiles(false);
        const LeafLayout written(tree);
        ASSERT_EQ(written.leafCount(), layout.leafCount());
        for (uint32_t leaf = 0; leaf < layout.leafCount(); ++leaf) {
            ASSERT_EQ(written.origin(leaf), layout.origin(leaf));
            ASSERT_EQ(written.mask(leaf), layout.mask(leaf));
        }
    }
}

TEST(LeafLayout, InactiveTilesAreBackground)
{
    MaskTree tree(false);
    tree.addTile(1, Coord(0, 0, 0), false, false);
    tree.addTile(2, Coord(128, 0, 0), false, false);
    EXPECT_EQ(LeafLayout(tree).leafCount(), 0u);
}

TEST(LeafLayout, VoxelsFarApartAreTwoLeaves)
{
    for (int far : {1000000, 1 << 27}) {
        const LeafLayout layout(*maskOf(Voxels{Coord(-far, 0, 0), Coord(far, 0, 0)}));
        EXPECT_EQ(layout.leafCount(), 2u);
        EXPECT_EQ(layout.runCount(Axis::X), 2u);
    }
}

TEST(LeafLayout, AnObjectOfTooManyLeavesIsAnErrorBeforeMemoryIsTaken)
{
    openvdb::MaskTree tree(false);
    for (int i = 0; i < 17; ++i) tree.root().addTile(openvdb::Coord(4096 * i, 0, 0), true, true);
    try {
        const openvdb_spheretree::LeafLayout layout(tree);
        FAIL() << "17 tiles of 4096^3 voxels fit nowhere";
    } catch (const openvdb::ValueError& error) {
        EXPECT_NE(std::string(error.what()).find("2281701376 leaf nodes"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("more than 2^31"), std::string::npos);
    }
}

TEST(LeafLayout, AnObjectThatNeedsMoreMemoryThanThereIsIsAnError)
{
    EXPECT_NO_THROW(openvdb_spheretree::detail::requireMemory(1000, 10000));
    EXPECT_THROW(openvdb_spheretree::detail::requireMemory(int64_t(1) << 40, int64_t(1) << 20),
        openvdb::ValueError);
}

} // namespace
