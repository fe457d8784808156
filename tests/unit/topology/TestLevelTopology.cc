// SPDX-License-Identifier: Apache-2.0
/// @file TestLevelTopology.cc
/// @brief Shapes whose Betti numbers are known. Against dense floods: oracle/TestTopologyOracle.cc.

#include "support/CoreStages.h"
#include "support/DenseTopology.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/topology/LevelTopology.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

LevelTopology topologyOf(const Voxels& voxels) { return levelTopology(*gridOf(voxels)); }

LevelTopology betti(int64_t components, int64_t tunnels, int64_t cavities)
{
    return {components, tunnels, cavities};
}

Voxels torus(double large, double small)
{
    const int r = int(large + small) + 1, h = int(small) + 1;
    Voxels voxels;
    for (const Coord& v : voxelsOfBox(CoordBBox(Coord(-r, -r, -h), Coord(r, r, h)))) {
        if (std::hypot(std::hypot(v[0], v[1]) - large, v[2]) < small) voxels.push_back(v);
    }
    return voxels;
}

TEST(LevelTopology, NothingHasNoParts) { EXPECT_EQ(topologyOf({}), betti(0, 0, 0)); }

TEST(LevelTopology, ABallIsOnePart)
{
    EXPECT_EQ(topologyOf({Coord(5, -3, 7)}), betti(1, 0, 0));
    EXPECT_EQ(topologyOf(shapes::ball(400)), betti(1, 0, 0));
}

TEST(LevelTopology, ATorusHasATunnel)
{
    EXPECT_EQ(topologyOf(torus(6, 2.5)), betti(1, 1, 0));
    EXPECT_EQ(topologyOf(torus(40, 9)), betti(1, 1, 0)); // whole leaves are empty in its middle
}

TEST(LevelTopology, AHollowBallHasACavityHoweverLarge)
{
    EXPECT_EQ(topologyOf(shapes::ball(100, 50)), betti(1, 0, 1));
    EXPECT_EQ(topologyOf(shapes::ball(40 * 40, 37 * 37)), betti(1, 0, 1));
}

TEST(LevelTopology, CubesThatShareAnEdgeOrACornerAreOnePart)
{
    for (const Coord& other : {Coord(1, 0, 0), Coord(1, 1, 0), Coord(0, -1, 1), Coord(1, -1, 1)}) {
        for (const Coord& at : {Coord(3, 3, 3), Coord(7, 8, 7), Coord(0, 0, 0)}) {
            EXPECT_EQ(topologyOf({at, at + other}), betti(1, 0, 0)) << at << other;
            EXPECT_EQ(topologyOf({at, at + other + other}), betti(2, 0, 0)) << at << other;
        }
    }
}

/// An arch in one leaf: its feet meet only above, or below, or beside, the planes that they stand on.
TEST(LevelTopology, AnArchIsOnePartWhicheverWayItStands)
{
    for (int axis = 0; axis < 3; ++axis) {
        for (int foot : {1, 6}) {
            const int top = foot == 1 ? 4 : 3, step = foot == 1 ? 1 : -1;
            Voxels arch;
            const auto add = [&](int height, int aside) {
                Coord& voxel = arch.emplace_back(0, 0, 0);
                voxel[axis] = height;
                voxel[(axis + 1) % 3] = aside;
            };
            for (int aside = 1; aside <= 4; ++aside) add(top, aside);
            for (int height = foot; height != top; height += step) add(height, 1), add(height, 4);
            std::sort(arch.begin(), arch.end());
            EXPECT_EQ(topologyOf(arch), betti(1, 0, 0)) << axis << ' ' << foot;
        }
    }
    EXPECT_EQ(topologyOf({Coord(0, 0, 0), Coord(0, 0, 2), Coord(1, 0, 1)}), betti(1, 0, 0));
    EXPECT_EQ(topologyOf({Coord(6, 0, 1), Coord(7, 0, 0), Coord(7, 0, 2)}), betti(1, 0, 0));
}

TEST(LevelTopology, BackgroundThatSharesOnlyACornerOrAnEdgeIsNotConnected)
{
    Voxels cube = shapes::box(Coord(6));
    const auto without = [&](const Coord& a, const Coord& b) {
        Voxels voxels;
        for (const Coord& v : cube) {
            if (v != a && v != b) voxels.push_back(v);
        }
        return topologyOf(voxels);
    };
    EXPECT_EQ(without(Coord(2), Coord(2, 2, 3)), betti(1, 0, 1));
    EXPECT_EQ(without(Coord(2), Coord(2, 3, 3)), betti(1, 0, 2));
    EXPECT_EQ(without(Coord(2), Coord(3, 3, 3)), betti(1, 0, 2));
    EXPECT_EQ(without(Coord(2, 2, 0), Coord(2, 3, 1)), betti(1, 0, 1)); // beside a dent
}

/// Bars of one voxel along the edges of n x n x n cells: edges - vertices + 1 independent loops.
TEST(LevelTopology, ALatticeHasATunnelForEveryLoop)
{
    for (const int n : {1, 2, 5}) {
        Voxels voxels;
        for (const Coord& v : shapes::box(Coord(4 * n + 1))) {
            if ((v[0] % 4 == 0) + (v[1] % 4 == 0) + (v[2] % 4 == 0) >= 2) voxels.push_back(v);
        }
        const int64_t vertices = int64_t(n + 1) * (n + 1) * (n + 1);
        const int64_t edges = 3 * int64_t(n) * (n + 1) * (n + 1);
        EXPECT_EQ(topologyOf(voxels), betti(1, edges - vertices + 1, 0)) << n;
    }
}

TEST(LevelTopology, ShellsWithinShellsCountOneByOne)
{
    Voxels voxels;
    for (int side = 8; side <= 56; side += 12) {
        const CoordBBox outer(Coord(-side), Coord(side));
        CoordBBox inner = outer;
        inner.expand(-2);
        for (const Coord& v : voxelsOfBox(outer)) {
            if (!inner.isInside(v)) voxels.push_back(v);
        }
    }
    EXPECT_EQ(topologyOf(voxels), betti(5, 0, 5));
}

TEST(LevelTopology, AnEmptyTowerInsideAShellIsNotOpenAtItsEnds)
{
    // A frame far away makes every column of leaves one with leaves before and behind its holes.
    const auto shell = [](const CoordBBox& box, openvdb::MaskTree& mask) {
        CoordBBox inner = box;
        inner.expand(-8);
        mask.sparseFill(box, true);
        mask.sparseFill(inner, false, false);
    };
    openvdb::MaskTree mask(false);
    shell(CoordBBox(Coord(-64), Coord(255)), mask);
    shell(CoordBBox(Coord(0), Coord(127)), mask);
    EXPECT_EQ(levelTopology(LeafLayout(mask)), betti(2, 0, 2));
    // Windows through both, at one end.
    mask.fill(CoordBBox(Coord(40, 40, 120), Coord(41, 41, 300)), false, false);
    EXPECT_EQ(levelTopology(LeafLayout(mask)), betti(2, 0, 0));
    mask.fill(CoordBBox(Coord(60, 60, 120), Coord(61, 61, 300)), false, false);
    EXPECT_EQ(levelTopology(LeafLayout(mask)), betti(2, 2, 0));
}

TEST(LevelTopology, AHoleInThePlaneIsATunnel)
{
    Voxels ring = shapes::box(Coord(30, 30, 1));
    ring.erase(std::remove_if(ring.begin(), ring.end(),
                   [](const Coord& v) { return v[0] % 10 == 5 && v[1] % 10 == 5; }),
        ring.end());
    EXPECT_EQ(topologyOf(ring), betti(1, 9, 0));
}

TEST(LevelTopology, TilesAreTheVoxelsTheyStandFor)
{
    const CoordBBox box(Coord(-130, -8, 0), Coord(300, 135, 140));
    const auto grid = gridOf(*maskOf(box));
    EXPECT_GT(grid->tree().activeTileCount(), 0u);
    EXPECT_EQ(levelTopology(*grid), betti(1, 0, 0));
}

TEST(LevelTopology, LeavesAtTheEndsOfTheCoordinatesDoNotTouch)
{
    constexpr int kLow = std::numeric_limits<int>::min(), kHigh = std::numeric_limits<int>::max();
    EXPECT_EQ(topologyOf({Coord(0, 0, kLow), Coord(0, 0, kHigh)}), betti(2, 0, 0));
    EXPECT_EQ(topologyOf({Coord(kLow, kLow, 0), Coord(kHigh, kHigh, 0)}), betti(2, 0, 0));
}

TEST(LevelTopology, StopsWhenInterrupted)
{
    const LeafLayout layout(*maskOf(shapes::ball(400)));
    StopAfter atOnce(0), amidst(1);
    EXPECT_THROW(levelTopology(layout, &atOnce), Interrupted);
    EXPECT_THROW(levelTopology(layout, &amidst), Interrupted);
}

} // namespace
