// SPDX-License-Identifier: Apache-2.0
/// @file TestTopologyOracle.cc
/// @brief Betti numbers against floods of dense arrays.

#include "support/BuiltTrees.h"
#include "support/CoreStages.h"
#include "support/DenseAgreement.h"
#include "support/DenseTopology.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/topology/LevelTopology.h>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

LevelTopology topologyOf(const Voxels& voxels)
{
    return levelTopology(LeafLayout(*maskOf(voxels)));
}

Voxels movedBy(Voxels voxels, const Coord& shift)
{
    for (Coord& voxel : voxels) voxel += shift;
    return voxels;
}

Voxels maskOf2x2x3(int mask, const Coord& corner)
{
    Voxels voxels;
    for (int i = 0; i < 12; ++i) {
        if (mask >> i & 1) voxels.push_back(corner + Coord(i & 1, i >> 1 & 1, i >> 2));
    }
    return voxels;
}

/// Where the box lies across a corner, edges and faces of leaves, and on the sign of coordinates.
TEST(TopologyOracle, EveryMaskOf2x2x3InsideALeafAndAcrossItsBorders)
{
    for (const Coord& corner : {Coord(2, 3, 4), Coord(-1, -1, -2), Coord(7, 3, 15), Coord(3, 7, 7),
             Coord(-9, 4, 1), Coord(4, 7, 4), Coord(4, 4, 6)}) {
        for (int mask = 1; mask < 1 << 12; ++mask) {
            const Voxels voxels = maskOf2x2x3(mask, corner);
            ASSERT_EQ(topologyOf(voxels), DenseTopology(voxels).numbers())
                << "mask " << mask << " at " << corner;
        }
    }
}

TEST(TopologyOracle, NoiseOfAnyDensity)
{
    for (uint32_t seed = 1; seed <= 2000; ++seed) {
        Random random(seed);
        const double rate = 0.05 + 0.05 * (seed % 19);
        Voxels voxels = shapes::noise(seed % 4 ? Coord(6) : Coord(19, 20, 18), rate, random);
        if (voxels.empty()) continue;
        voxels = movedBy(voxels, random.coord(-20, 20));
        ASSERT_EQ(topologyOf(voxels), DenseTopology(voxels).numbers()) << "seed " << seed;
    }
}

TEST(TopologyOracle, EveryShapeOfRandomObjects)
{
    for (const RandomObject& object : someObjects(7000, 600)) {
        ASSERT_EQ(topologyOf(object.voxels), DenseTopology(object.voxels).numbers()) << object.name;
    }
}

/// Cubes as large as leaves: what is between them is seen by its absence only.
TEST(TopologyOracle, EmptyLeavesInsideAndBetweenObjects)
{
    for (uint32_t seed = 1; seed <= 150; ++seed) {
        Random random(seed);
        const double rate = 0.2 + 0.1 * (seed % 7);
        const Coord leaf = random.coord(-5, 5); // << of a negative number is undefined in C++17
        const Coord at = Coord(8 * leaf[0], 8 * leaf[1], 8 * leaf[2])
            + (seed % 3 ? Coord(0) : random.coord(0, 7));
        Voxels voxels;
        for (const Coord& block : shapes::noise(Coord(4, 5, 6), rate, random)) {
            const CoordBBox box = CoordBBox::createCube(at + (block << 3), 8);
            for (const Coord& voxel : voxelsOfBox(box)) voxels.push_back(voxel);
        }
        if (voxels.empty()) continue;
        ASSERT_EQ(topologyOf(voxels), DenseTopology(voxels).numbers()) << "seed " << seed;
    }
}

/// Shells whose walls are thinner than a leaf and whose rooms are larger, with windows.
TEST(TopologyOracle, RoomsOfEmptyLeavesWithAndWithoutWindows)
{
    for (uint32_t seed = 1; seed <= 150; ++seed) {
        Random random(seed);
        const Coord size = Coord(12) + random.coord(0, 34);
        const CoordBBox outer(Coord(0), size - Coord(1));
        const Coord window = random.coord(0, 45), wall = random.coord(0, 45);
        Voxels voxels;
        for (const Coord& v : voxelsOfBox(outer)) {
            CoordBBox inner = outer;
            inner.expand(-1);
            const bool inWall = !inner.isInside(v) || (seed % 2 && v[0] == wall[0]);
            const bool inWindow = seed % 3 && v[1] == window[1] && v[2] == window[2];
            if (inWall && !inWindow) voxels.push_back(v);
        }
        voxels = movedBy(voxels, random.coord(-50, 50));
        ASSERT_EQ(topologyOf(voxels), DenseTopology(voxels).numbers()) << "seed " << seed;
    }
}

TEST(TopologyOracle, FlatObjectsHaveTheNumbersOfThePlane)
{
    for (uint32_t seed = 1; seed <= 400; ++seed) {
        Random random(seed);
        const int axis = int(seed % 3);
        Coord size(21, 22, 23);
        size[axis] = 1;
        Voxels voxels = shapes::noise(size, 0.1 * (1 + seed % 9), random);
        if (voxels.empty()) continue;
        voxels = movedBy(voxels, random.coord(-30, 30));
        ASSERT_EQ(topologyOf(voxels), DenseTopology(voxels).numbersInPlane(axis))
            << "seed " << seed;
    }
}

TEST(TopologyOracle, ObjectsFarApartAddUp)
{
    const auto objects = someObjects(8000, 61);
    for (std::size_t i = 1; i < objects.size(); ++i) {
        Coord shift(0);
        shift[int(i % 3)] = i % 2 ? 1000000 : -1000000;
        Voxels voxels = movedBy(objects[i].voxels, shift);
        const LevelTopology a = DenseTopology(objects[i - 1].voxels).numbers();
        const LevelTopology b = DenseTopology(objects[i].voxels).numbers();
        const LevelTopology sum{
            a.components + b.components, a.tunnels + b.tunnels, a.cavities + b.cavities};
        voxels.insert(voxels.end(), objects[i - 1].voxels.begin(), objects[i - 1].voxels.end());
        ASSERT_EQ(topologyOf(voxels), sum) << objects[i - 1].name << " and " << objects[i].name;
    }
}

/// Of the volume whose medial balls the level has, which in an extended tree is no pyramid level.
TEST(TopologyOracle, EveryLevelOfATreeHasThatOfItsVolume)
{
    int holes = 0;
    for (const RandomObject& object : someObjects(9000, 132)) {
        DenseTreeBuilder dense(object.voxels);
        for (const SphereTreeSettings& settings : bothTypes()) {
            const auto expected = dense.build(denseSettings(settings));
            const SphereTree tree = buildSphereTree(*gridOf(object.voxels), settings);
            ASSERT_EQ(tree.levels.size(), expected.size());
            for (std::size_t k = 0; k < expected.size(); ++k) {
                ASSERT_TRUE(tree.levels[k].topology);
                ASSERT_EQ(*tree.levels[k].topology, DenseTopology(expected[k].voxels).numbers())
                    << object.name << ", " << describe(settings) << ", level " << k;
                holes += k > 0 && tree.levels[k].topology->tunnels > 0;
            }
        }
    }
    EXPECT_GT(holes, 15) << "levels above 0 have hardly any topology to get wrong";
}

TEST(TopologyOracle, TheNumberOfThreadsMakesNoDifference)
{
    Random random(1);
    const Voxels voxels = shapes::noise(Coord(70, 60, 80), 0.3, random);
    const LevelTopology expected = DenseTopology(voxels).numbers();
    const LeafLayout layout(*maskOf(voxels));
    for (const int threads : {1, 2, 3, 7}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        for (int run = 0; run < 5; ++run) ASSERT_EQ(levelTopology(layout), expected) << threads;
    }
}

} // namespace
