// SPDX-License-Identifier: Apache-2.0
/// @file TestXGaps.cc
/// @brief Gaps to the background along x against walks from voxel to voxel.

#include <openvdb_spheretree/kernel/LeafRows.h>
#include <openvdb_spheretree/slab/XGaps.h>

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// The distance to the nearest voxel that is off on the line along x.
int64_t gapAlongX(const std::set<Coord>& voxels, const Coord& voxel)
{
    int64_t gap = 0;
    while (voxels.count(voxel.offsetBy(int(gap), 0, 0))
        && voxels.count(voxel.offsetBy(-int(gap), 0, 0))) {
        ++gap;
    }
    return gap;
}

template <typename Gap, typename Square>
void expectSquares(const Voxels& voxels, int64_t most)
{
    const std::set<Coord> all(voxels.begin(), voxels.end());
    const LeafLayout layout(*maskOf(voxels));
    const slab::XGaps<Gap> gaps(layout, nullptr);
    std::array<Square, kLeafVoxels> rows, squares;
    for (uint32_t leaf = 0; leaf < layout.leafCount(); ++leaf) {
        gaps.squares(leaf, rows.data());
        detail::rowsToLeaf(Axis::Y, rows.data(), squares.data());
        for (uint32_t k = 0; k < kLeafVoxels; ++k) {
            const int64_t expected = std::min(most, gapAlongX(all, layout.voxel(leaf, k)));
            ASSERT_EQ(int64_t(squares[k]), expected * expected) << layout.voxel(leaf, k);
        }
    }
}

TEST(XGaps, AreThoseOfEveryLine)
{
    for (uint32_t seed = 0; seed < 30; ++seed) {
        const Voxels voxels = randomObject(seed).voxels;
        ASSERT_NO_FATAL_FAILURE((expectSquares<uint8_t, uint16_t>(voxels, 255))) << seed;
        ASSERT_NO_FATAL_FAILURE((expectSquares<uint16_t, uint32_t>(voxels, 46340))) << seed;
    }
}

TEST(XGaps, StayAtTheLargestNumberThatFits)
{
    Voxels line;
    for (int x = -300; x < 400; ++x) line.push_back(Coord(x, 3, 5));
    ASSERT_NO_FATAL_FAILURE((expectSquares<uint8_t, uint16_t>(line, 255)));
    ASSERT_NO_FATAL_FAILURE((expectSquares<uint16_t, uint32_t>(line, 46340)));
}

} // namespace
