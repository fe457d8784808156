// SPDX-License-Identifier: Apache-2.0
/// @file detail/LeafBall.cc
/// @brief A voxel is inside when dy^2 + dz^2 <= coverSq - dx^2. The 64 sums on the left are computed
/// once; the right side is one value for each of the 8 words. They are compared four at a time, as
/// 16-bit lanes of a 64-bit integer. (A square root a row, 64 a leaf, took four times as long.)
///
/// Both sides are shifted so that the right one starts at 0, and stays below 2^15 - 1 by the bound on
/// distances; clamping the left one to 15 bits then changes no comparison. Exact.

#include "LeafBall.h"

#include <algorithm>

namespace openvdb_spheretree {
namespace detail {
namespace {

constexpr uint64_t kEveryLane = 0x0001000100010001;
constexpr uint64_t kTopBits = kEveryLane << 15;

/// Eight values below 2^15, of z = 0...3 and 4...7, lowest lane first.
struct Row {
    uint64_t low, high;
};

Row rowOf(const int32_t squares[8], int32_t added)
{
    Row row{0, 0};
    for (int z = 0; z < 4; ++z) {
        const auto clamp = [](int32_t value) {
            return uint64_t(std::max(0, std::min(value, 32767)));
        };
        row.low |= clamp(squares[z] + added) << (16 * z);
        row.high |= clamp(squares[z + 4] + added) << (16 * z);
    }
    return row;
}

/// @return a bit for each z whose value is at most the limit (below 2^15, in every lane).
uint64_t atMost(const Row& row, uint64_t limits)
{
    const uint64_t low = ((limits | kTopBits) - row.low) & kTopBits; // no lane borrows
    const uint64_t high = ((limits | kTopBits) - row.high) & kTopBits;
    // Bits 0 and 4 of each lane now; the product brings those of lane i to bits 48 + i and 52 + i.
    constexpr uint64_t kGather = 0x0001000200040008;
    return (((low >> 15) | (high >> 11)) * kGather) >> 48 & 0xff;
}

} // namespace

void orBallIntoLeaf(const int64_t center2[3], int64_t coverSq, uint64_t words[8])
{
    int32_t squares[3][8];
    for (int a = 0; a < 3; ++a) {
        for (int i = 0; i < 8; ++i) {
            const auto d = int32_t(2 * i - center2[a]);
            squares[a][i] = d * d;
        }
    }
    const int32_t least = int32_t(coverSq) - *std::max_element(squares[0], squares[0] + 8);
    Row rows[8];
    for (int y = 0; y < 8; ++y) rows[y] = rowOf(squares[2], squares[1][y] - least);
    for (int x = 0; x < 8; ++x) {
        const uint64_t limits = uint64_t(int32_t(coverSq) - squares[0][x] - least) * kEveryLane;
        uint64_t word = 0;
        for (int y = 0; y < 8; ++y) word |= atMost(rows[y], limits) << (8 * y);
        words[x] |= word;
    }
}

} // namespace detail
} // namespace openvdb_spheretree
