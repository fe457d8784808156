// SPDX-License-Identifier: Apache-2.0
/// @file TestPartSelection.cc
/// @brief The largest part and filled cavities, against floods of dense boxes.

#include "support/NaiveReference.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/topology/PartSelection.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::MaskTree;

using Set = std::set<Coord>;

MaskTree treeOf(const Voxels& voxels)
{
    MaskTree tree(false);
    for (const Coord& voxel : voxels) tree.setValueOn(voxel);
    return tree;
}

Set setOf(const MaskTree& tree)
{
    Set voxels;
    for (auto value = tree.cbeginValueOn(); value; ++value) {
        openvdb::CoordBBox box;
        value.getBoundingBox(box);
        for (auto voxel = box.begin(); voxel; ++voxel) voxels.insert(*voxel);
    }
    return voxels;
}

/// @return all of @a among that paths of steps along up to @a axes axes join with @a start.
Set flooded(const Coord& start, const Set& among, int axes)
{
    Set found{start};
    std::vector<Coord> open{start};
    while (!open.empty()) {
        const Coord at = open.back();
        open.pop_back();
        for (auto step = CoordBBox(Coord(-1), Coord(1)).begin(); step; ++step) {
            const int moved = std::abs((*step)[0]) + std::abs((*step)[1]) + std::abs((*step)[2]);
            const Coord next = at + *step;
            if (moved > axes || !among.count(next) || !found.insert(next).second) continue;
            open.push_back(next);
        }
    }
    return found;
}

Set largestByFlood(const Voxels& voxels)
{
    Set left(voxels.begin(), voxels.end()), largest;
    while (!left.empty()) {
        const Set part = flooded(*left.begin(), left, 3);
        for (const Coord& voxel : part) left.erase(voxel);
        if (part.size() > largest.size()) largest = part;
    }
    return largest;
}

Set filledByFlood(const Voxels& voxels)
{
    CoordBBox box = boxOf(voxels);
    box.expand(1);
    Set all, background;
    for (auto voxel = box.begin(); voxel; ++voxel) all.insert(*voxel);
    background = all;
    for (const Coord& voxel : voxels) background.erase(voxel);
    for (const Coord& voxel : flooded(box.min(), background, 1)) all.erase(voxel);
    return all;
}

TEST(PartSelection, IsThatOfAFloodForRandomObjects)
{
    for (uint32_t seed = 0; seed < 60; ++seed) {
        const RandomObject object = randomObject(seed);
        if (boxOf(object.voxels).volume() > 100000) continue;
        SCOPED_TRACE(object.name);
        const MaskTree tree = treeOf(object.voxels);
        const Set largest = setOf(*largestPart(tree)), expected = largestByFlood(object.voxels);
        ASSERT_EQ(expected.size(), largest.size());
        EXPECT_EQ(largest, flooded(*largest.begin(), largest, 3)); // one part
        const Set own(object.voxels.begin(), object.voxels.end());
        EXPECT_EQ(largest, flooded(*largest.begin(), own, 3)); // and all of it
        EXPECT_EQ(filledByFlood(object.voxels), setOf(*withCavitiesFilled(tree)));
    }
}

/// What is between leaves has no voxels to look at, in columns that are beside others of other lengths.
TEST(PartSelection, FillsCavitiesOfWholeLeaves)
{
    for (const int reach : {20, 45}) {
        const Voxels shell = shapes::ball(reach * reach, (reach - 2) * (reach - 2));
        const MaskTree tree = treeOf(shell);
        EXPECT_EQ(filledByFlood(shell), setOf(*withCavitiesFilled(tree))) << reach;
        Voxels open = shell; // a hole along x, one voxel wide
        open.erase(std::remove_if(open.begin(), open.end(),
                       [](const Coord& v) { return v[0] > 0 && v[1] == 0 && v[2] == 0; }),
            open.end());
        EXPECT_EQ(Set(open.begin(), open.end()), setOf(*withCavitiesFilled(treeOf(open))));
    }
}

TEST(PartSelection, OfEqualPartsKeepsTheFirst)
{
    const MaskTree tree = treeOf({Coord(20, 0, 0), Coord(-3, 4, 5), Coord(20, 30, 0)});
    EXPECT_EQ(Set{Coord(-3, 4, 5)}, setOf(*largestPart(tree)));
}

TEST(PartSelection, OfTilesAreTiles)
{
    MaskTree tree(false);
    tree.fill(CoordBBox(Coord(0), Coord(127)), true);
    tree.setValueOn(Coord(200));
    const auto largest = largestPart(tree);
    EXPECT_EQ(0u, largest->leafCount());
    EXPECT_EQ(128u * 128 * 128, largest->activeVoxelCount());
    EXPECT_EQ(tree.activeVoxelCount(), withCavitiesFilled(tree)->activeVoxelCount());
    EXPECT_TRUE(largestPart(MaskTree(false))->empty());
    EXPECT_TRUE(withCavitiesFilled(MaskTree(false))->empty());
}

TEST(PartSelection, StopsWhenAskedTo)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    const MaskTree tree = treeOf({Coord(1)});
    EXPECT_THROW(largestPart(tree, &stop), Interrupted);
    EXPECT_THROW(withCavitiesFilled(tree, &stop), Interrupted);
}

} // namespace
