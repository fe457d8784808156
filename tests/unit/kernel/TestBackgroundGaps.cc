// SPDX-License-Identifier: Apache-2.0
/// @file TestBackgroundGaps.cc
/// @brief Squares of gaps where these are the largest that fit (TestXGaps.cc has all others).

#include <openvdb_spheretree/kernel/BackgroundGaps.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

using namespace openvdb_spheretree;

namespace {

/// In a leaf without background, whose lines have these gaps in the voxels beside it.
template <typename Gap, typename Square>
void expectSquares(int64_t before, int64_t behind, int64_t most)
{
    std::array<Gap, 64> low, high;
    low.fill(Gap(before));
    high.fill(Gap(behind));
    std::array<Square, kLeafVoxels> rows;
    slab::squaresOfGaps(LeafMask::full(), low.data(), high.data(), rows.data());
    for (int x = 0; x < 8; ++x) {
        const int64_t gap = std::min({before + 1 + x, behind + 8 - x, most});
        for (int y = 0; y < 8; ++y) {
            for (int z = 0; z < 8; ++z) {
                ASSERT_EQ(int64_t(rows[64 * y + 8 * x + z]), gap * gap)
                    << x << ' ' << y << ' ' << z;
            }
        }
    }
}

} // namespace

TEST(BackgroundGaps, BeyondTheLargestCountAsThatMuch)
{
    for (const int64_t before : {247, 250, 255}) {
        for (const int64_t behind : {248, 255}) {
            expectSquares<uint8_t, uint16_t>(before, behind, 255);
        }
    }
    for (const int64_t before : {46332, 46336, 46340, 50000, 65535}) {
        for (const int64_t behind : {46333, 60000, 65535}) {
            expectSquares<uint16_t, uint32_t>(before, behind, 46340);
        }
    }
}
