// SPDX-License-Identifier: Apache-2.0
/// @file TestObjectParts.cc
/// @brief The largest part and filled cavities, against floods of dense arrays; tiles; a scan.

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/input/vol/VolFile.h>
#include <openvdb_spheretree/topology/LevelTopology.h>
#include <openvdb_spheretree/topology/ObjectParts.h>

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::BoolGrid;
using VoxelSet = std::set<Coord>;

VoxelSet setOf(const BoolGrid& grid)
{
    VoxelSet voxels;
    for (auto it = grid.cbeginValueOn(); it; ++it) {
        CoordBBox box;
        it.getBoundingBox(box);
        for (const Coord& ijk : box) voxels.insert(ijk);
    }
    return voxels;
}

/// What can be reached from @a first in @a among, where up to @a steps coordinates differ by one.
VoxelSet flooded(const Coord& first, const VoxelSet& among, int steps)
{
    VoxelSet reached{first};
    std::vector<Coord> left{first};
    while (!left.empty()) {
        const Coord at = left.back();
        left.pop_back();
        for (const Coord& step : CoordBBox(Coord(-1), Coord(1))) {
            const Coord next = at + step;
            const int moved = std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]);
            if (moved > steps || !among.count(next)) continue;
            if (reached.insert(next).second) left.push_back(next);
        }
    }
    return reached;
}

VoxelSet largestByFlood(VoxelSet left)
{
    VoxelSet largest;
    while (!left.empty()) { // the first voxel of all that are left: ties keep the earlier part
        const VoxelSet part = flooded(*left.begin(), left, 3);
        for (const Coord& voxel : part) left.erase(voxel);
        if (part.size() > largest.size()) largest = part;
    }
    return largest;
}

VoxelSet filledByFlood(const VoxelSet& object)
{
    CoordBBox box;
    for (const Coord& voxel : object) box.expand(voxel);
    box.expand(1);
    VoxelSet background, filled;
    for (const Coord& voxel : box) {
        if (!object.count(voxel)) background.insert(voxel);
    }
    const VoxelSet outside = flooded(box.min(), background, 1);
    for (const Coord& voxel : box) {
        if (!outside.count(voxel)) filled.insert(voxel);
    }
    return filled;
}

void expectAsByFlood(const Voxels& voxels, const std::string& name)
{
    SCOPED_TRACE(name);
    const auto grid = gridOf(voxels);
    const VoxelSet object(voxels.begin(), voxels.end());
    EXPECT_EQ(setOf(*largestPart(*grid)), largestByFlood(object));
    EXPECT_EQ(setOf(*filledCavities(*grid)), filledByFlood(object));
}

TEST(ObjectParts, AreThoseOfAFloodOnRandomObjects)
{
    for (uint32_t seed = 1; seed <= 60; ++seed) {
        const RandomObject object = randomObject(seed);
        CoordBBox box;
        for (const Coord& voxel : object.voxels) box.expand(voxel);
        if (box.volume() > 60000) continue;
        expectAsByFlood(object.voxels, object.name);
    }
}

TEST(ObjectParts, AreThoseOfAFloodOnNoiseOfEveryDensity)
{
    for (uint32_t seed = 1; seed <= 8; ++seed) {
        Random random(seed);
        for (const double rate : {0.05, 0.3, 0.7, 0.9}) {
            Voxels voxels = shapes::noise(Coord(18, 19, 20), rate, random);
            placeOnBorder(voxels, random);
            expectAsByFlood(voxels, "noise " + std::to_string(seed) + " " + std::to_string(rate));
        }
    }
}

/// Whole leaf nodes are empty in it, some of them between others.
TEST(ObjectParts, ShellsWithinShellsAreFilled)
{
    Voxels voxels;
    for (int side : {4, 14, 22}) {
        const CoordBBox outer(Coord(-side), Coord(side));
        CoordBBox inner = outer;
        inner.expand(-1);
        for (const Coord& v : voxelsOfBox(outer)) {
            if (!inner.isInside(v)) voxels.push_back(v);
        }
    }
    std::sort(voxels.begin(), voxels.end());
    expectAsByFlood(voxels, "shells");
}

TEST(ObjectParts, OfEqualPartsTheFirstIsKept)
{
    const auto first = [](const Voxels& voxels) {
        return *setOf(*largestPart(*gridOf(voxels))).begin();
    };
    EXPECT_EQ(first({Coord(0, 0, 9), Coord(5, 0, 0)}), Coord(0, 0, 9));
    EXPECT_EQ(first({Coord(-9, 0, 0), Coord(5, 0, 0)}), Coord(-9, 0, 0));
    // The first leaf node is that of the part which begins later.
    EXPECT_EQ(first({Coord(1, 12, 0), Coord(2, 1, 0)}), Coord(1, 12, 0));
}

openvdb::MaskTree::Ptr hollow(const CoordBBox& box, int wall)
{
    auto mask = std::make_shared<openvdb::MaskTree>(false);
    CoordBBox inner = box;
    inner.expand(-wall);
    mask->sparseFill(box, true);
    mask->sparseFill(inner, false, false);
    return mask;
}

TEST(ObjectParts, AHugeCavityIsFilledByTiles)
{
    const CoordBBox box(Coord(-8), Coord(1023 + 8));
    const auto filled = filledCavities(*gridOf(*hollow(box, 8)));
    EXPECT_EQ(filled->activeVoxelCount(), box.volume());
    EXPECT_EQ(filled->tree().leafCount(), 0u);
    // 8^3 nodes of 128^3, and those around, which have parts of the wall in them.
    EXPECT_LT(filled->tree().activeTileCount(), 512u + 6 * 130 * 130 + 13 * 130);
    EXPECT_TRUE(filled->tree().isValueOn(Coord(500)));
    EXPECT_EQ(filled->tree().getValueDepth(Coord(500)), 1);
}

TEST(ObjectParts, ANodeWithoutVoxelsIsNoMoreThanEmptySpace)
{
    const auto grid = gridOf(*hollow(CoordBBox(Coord(0), Coord(39)), 3));
    grid->tree().touchLeaf(Coord(16));
    grid->tree().touchLeaf(Coord(100));
    EXPECT_EQ(filledCavities(*grid)->activeVoxelCount(), 40u * 40 * 40);
    EXPECT_EQ(largestPart(*grid)->activeVoxelCount(), grid->activeVoxelCount());
}

TEST(ObjectParts, ACavityWithAWindowIsNone)
{
    const auto mask = hollow(CoordBBox(Coord(-8), Coord(263)), 8);
    mask->fill(CoordBBox(Coord(40, 40, 250), Coord(40, 40, 263)), false, false);
    const auto grid = gridOf(*mask);
    EXPECT_EQ(filledCavities(*grid)->activeVoxelCount(), grid->activeVoxelCount());
}

TEST(ObjectParts, TilesOfOtherPartsAreDroppedAndTheRestStayTiles)
{
    const auto grid = BoolGrid::create(false);
    grid->setName("tiles");
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    grid->tree().addTile(2, Coord(0), true, true);
    grid->tree().addTile(1, Coord(128, 0, 0), true, true);
    grid->tree().addTile(1, Coord(512, 0, 0), true, true);
    grid->tree().addTile(2, Coord(-1024, 0, 0), true, true);
    const auto part = largestPart(*grid);
    EXPECT_EQ(part->activeVoxelCount(), uint64_t(128) * 128 * 128 + 512);
    EXPECT_EQ(part->tree().activeTileCount(), 2u);
    EXPECT_TRUE(part->tree().isValueOn(Coord(135, 7, 7)));
    EXPECT_EQ(part->getName(), "tiles");
    EXPECT_EQ(part->voxelSize()[0], 0.25);
}

TEST(ObjectParts, NothingHasNoParts)
{
    EXPECT_EQ(largestPart(*BoolGrid::create(false))->activeVoxelCount(), 0u);
    EXPECT_EQ(filledCavities(*BoolGrid::create(false))->activeVoxelCount(), 0u);
}

TEST(ObjectParts, StopWhenInterrupted)
{
    const auto ball = gridOf(shapes::ball(400, 100));
    StopAfter atOnce(0), largest(2), filled(2);
    EXPECT_THROW(largestPart(*ball, &atOnce), Interrupted);
    EXPECT_THROW(largestPart(*ball, &largest), Interrupted);
    EXPECT_THROW(filledCavities(*ball, &filled), Interrupted);
}

TEST(ObjectParts, OfAScanOnePartWithoutCavitiesIsLeft)
{
    const char* data = std::getenv("SPHERETREE_DATA");
    if (!data) GTEST_SKIP() << "needs SPHERETREE_DATA";
    const auto object = objectOf(*readVolFile(std::string(data) + "/vol/lobster.vol"));
    EXPECT_EQ(levelTopology(*object).components, 32);
    EXPECT_EQ(levelTopology(*object).cavities, 384);
    const auto part = largestPart(*object);
    EXPECT_EQ(levelTopology(*part).components, 1);
    const auto filled = filledCavities(*part);
    EXPECT_EQ(levelTopology(*filled).components, 1);
    EXPECT_EQ(levelTopology(*filled).cavities, 0);
    EXPECT_LE(
        levelTopology(*filled).tunnels, levelTopology(*part).tunnels); // cavities may have some
    EXPECT_GT(filled->activeVoxelCount(), part->activeVoxelCount());
}

} // namespace
