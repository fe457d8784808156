// SPDX-License-Identifier: Apache-2.0
/// @file TestBlockModel.cc
/// @brief Pyramid models given as a function of child blocks: what the function sees, and when it
/// is asked.

#include "support/CoreStages.h"
#include "support/Messages.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/pyramid/BlockModel.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>

#include <atomic>
#include <mutex>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::MaskTree;

bool orOfChildren(const ChildBlock& block) { return block.any(); }

/// All blocks next to `ijk`, itself included.
Voxels aroundOf(const Coord& ijk, int dim)
{
    const int high = dim == 3 ? 1 : 0;
    return voxelsOfBox(CoordBBox(ijk - Coord(1, 1, high), ijk + Coord(1, 1, high)));
}

TEST(BlockModel, TheOrOfAllChildrenIsTheOrModel)
{
    for (uint32_t seed = 0; seed < 44; ++seed) {
        const RandomObject object = randomObject(seed);
        const auto mask = maskOf(object.voxels);
        if (seed % 2) mask->prune();
        const PyramidStep step{Coord(-8, 0, 8), 2 + int(seed % 4), 2 + int(seed % 2)};
        EXPECT_EQ(voxelsOf(*blockModel(orOfChildren)(*mask, step)), voxelsOf(*coarsen(*mask, step)))
            << object.name;
    }
}

TEST(BlockModel, TheFunctionIsAskedOnceAboutEachVoxelNextToAnOnOneOutsideTiles)
{
    for (const int dim : {2, 3}) {
        Voxels voxels = shapes::ball(150); // its inside becomes a tile with factor 1 only
        if (dim == 2) {
            for (Coord& voxel : voxels) voxel[2] = 3;
            sortVoxels(voxels);
        }
        const PyramidStep step{Coord(-16, 0, 0), 2, dim};
        const auto orLevel = coarsen(*maskOf(voxels), step);
        ASSERT_EQ(orLevel->activeTileCount(), 0u);
        std::set<Coord> expected;
        for (const Coord& voxel : voxelsOf(*orLevel)) {
            for (const Coord& near : aroundOf(voxel, dim)) expected.insert(near);
        }
        std::mutex mutex;
        Voxels asked;
        const auto ask = [&](const ChildBlock& block) {
            const std::lock_guard<std::mutex> lock(mutex);
            asked.push_back(block.parent());
            return block.any();
        };
        blockModel(ask)(*maskOf(voxels), step);
        std::sort(asked.begin(), asked.end());
        EXPECT_EQ(asked, Voxels(expected.begin(), expected.end())) << "dim " << dim;
    }
}

TEST(BlockModel, TheFunctionSeesTheChildrenOfItsBlockAndOfThoseAround)
{
    for (uint32_t seed = 0; seed < 44; ++seed) {
        const RandomObject object = randomObject(200 + seed);
        const std::set<Coord> on(object.voxels.begin(), object.voxels.end());
        const PyramidStep step{Coord(8, -8, 0), 2 + int(seed % 4) * 3, 3};
        std::atomic<int> wrong{0};
        const auto look = [&](const ChildBlock& block) {
            const int f = block.factor();
            const Coord p = block.parent();
            const Coord first = step.origin + Coord(f * p[0], f * p[1], f * p[2]);
            int64_t count = 0;
            bool left = false;
            for (const Coord& q :
                voxelsOfBox(CoordBBox(Coord(-f, 0, 0), Coord(2 * f - 1, f - 1, f - 1)))) {
                const bool isOn = on.count(first + q) > 0;
                wrong += isOn != block.isOn(q[0], q[1], q[2]);
                count += isOn && q[0] >= 0 && q[0] < f;
                left = left || (isOn && q[0] < 0);
            }
            wrong += count != block.count();
            wrong += (count > 0) != block.any();
            wrong += left != block.any(-1, 0, 0);
            wrong += f != step.factor || block.dim() != 3;
            return block.any();
        };
        blockModel(look)(*maskOf(object.voxels), step);
        EXPECT_EQ(wrong, 0) << object.name;
    }
}

TEST(BlockModel, CountsTilesOfAllSizes)
{
    MaskTree tree(false);
    tree.addTile(3, Coord(0, 0, 0), true, true);
    tree.addTile(2, Coord(4096, 0, 0), true, true);
    tree.addTile(1, Coord(4096, 512, 0), true, true);
    tree.setValueOn(Coord(8191, 4095, 4095));
    tree.setValueOff(Coord(1, 1, 1));
    std::atomic<int64_t> first{0}, second{0};
    const auto look = [&](const ChildBlock& block) {
        if (block.parent() == Coord(0, 0, 0)) first = block.count();
        if (block.parent() == Coord(1, 0, 0)) second = block.count();
        return block.any();
    };
    blockModel(look)(tree, PyramidStep{Coord(), 4096, 3});
    EXPECT_EQ(first, (int64_t(1) << 36) - 1);
    EXPECT_EQ(second, (int64_t(1) << 21) + 512 + 1);
}

TEST(BlockModel, MayAddVoxelsBetweenOthers)
{
    const auto bridge = [](const ChildBlock& block) {
        return block.any() || (block.any(-1, 0, 0) && block.any(1, 0, 0));
    };
    const Voxels object{Coord(0, 0, 0), Coord(4, 0, 0), Coord(12, 0, 0)};
    const OrPyramid pyramid = buildOrPyramid(*gridOf(object), 2, 3, blockModel(bridge));
    EXPECT_EQ(voxelsOf(*pyramid.levels[1]),
        (Voxels{Coord(0, 0, 0), Coord(1, 0, 0), Coord(2, 0, 0), Coord(6, 0, 0)}));
    EXPECT_EQ(pyramid.levels.back()->activeVoxelCount(), 1u);
}

TEST(BlockModel, KeepsTilesWithoutAsking)
{
    MaskTree tree(false);
    tree.addTile(3, Coord(0, 0, 0), true, true);
    std::atomic<int> asked{0};
    const auto count = [&](const ChildBlock& block) {
        ++asked;
        return block.any();
    };
    const auto parents = blockModel(count)(tree, PyramidStep{Coord(), 64, 3});
    EXPECT_EQ(asked, 66 * 66 * 66 - 64 * 64 * 64);
    EXPECT_TRUE(parents->hasSameTopology(*coarsen(tree, PyramidStep{Coord(), 64, 3})));
}

TEST(BlockModel, OneThatIsNotIncludingIsRefusedWithTheFirstVoxelItLoses)
{
    const auto most = [](const ChildBlock& block) { return block.count() >= 5; };
    const Voxels object{Coord(0, 0, 0), Coord(3, 0, 0), Coord(20, 9, 9)};
    const std::string why = messageOf<openvdb::ValueError>(
        [&] { buildOrPyramid(*gridOf(object), 2, 3, blockModel(most)); });
    EXPECT_TRUE(mentions(why, "not including: it leaves out 3 voxels with a child that is on"));
    EXPECT_TRUE(mentions(why, "(first: [0, 0, 0])"));
}

TEST(BlockModel, AddsNothingAlongZInTwoDimensions)
{
    const auto all = [](const ChildBlock&) { return true; };
    const Voxels object{Coord(0, 0, 5), Coord(3, 0, 5), Coord(20, 9, 5)};
    const PyramidStep step{Coord(), 2, 2};
    for (const Coord& voxel : voxelsOf(*blockModel(all)(*maskOf(object), step))) {
        EXPECT_EQ(voxel[2], 5);
    }
    const auto thick = [](const MaskTree& level, const PyramidStep& s) {
        const auto next = coarsen(level, s);
        next->setValueOn(Coord(0, 0, 6));
        return next;
    };
    const std::string why =
        messageOf<openvdb::ValueError>([&] { nextLevel(*maskOf(object), step, thick); });
    EXPECT_TRUE(mentions(why, "adds voxels along z"));
}

} // namespace
