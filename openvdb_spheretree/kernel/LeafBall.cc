// SPDX-License-Identifier: Apache-2.0
/// @file LeafBall.cc
/// @brief With S units a voxel and center c, a voxel q is inside when
///     |S q - c|^2 <= radiusSq   <=>   S/2 |q|^2 - q.c <= floor((radiusSq - |c|^2) / 2S)
/// as the left side is an integer. It is a sum of a term t(i) = i (S/2 i - c) for each axis. The 64
/// sums of the terms of y and z are computed once; what is left is a limit for each of the 8 words,
/// and 64 comparisons of 16-bit lanes a word. (A square root a row took ten times as long.)
///
/// Exact. Let r = kLeafBallReach, with |S q - c| <= r along each axis.
/// - 16 bits: both sides are shifted so that the least limit is 0. Limits differ by no more than
///   the terms of x do: 49/2 S if the center is between the voxels along x, else 7 r - 49/2 S. Both
///   are below 2^15 - 1 for S up to 1024, so saturating the left side changes no comparison.
/// - 32 bits: the corner voxel is near, so coordinates of c are at most r, and 3 r^2 < 2^26.

#include "LeafBall.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/kernel/LeafBall.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cstdlib>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

void orBall(const int64_t center[3], int64_t radiusSq, int shift, uint64_t words[8])
{
#if HWY_TARGET == HWY_SCALAR
    orBallIntoLeafPortable(center, radiusSq, shift, words);
#else
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::CappedTag<int32_t, 8> d32;
    const hn::Rebind<int16_t, decltype(d32)> dHalf;
    const hn::CappedTag<int16_t, 32> d16;
    const BallTerms ball(center, radiusSq, shift);
    HWY_ALIGN int16_t sums[64];
    for (int y = 0; y < 8; ++y) {
        const auto rest = hn::Set(d32, ball.ofY[y] - ball.least);
        for (std::size_t z = 0; z < 8; z += hn::Lanes(d32)) {
            const auto sum = hn::Add(hn::Load(d32, ball.ofZ + z), rest);
            hn::Store(hn::DemoteTo(dHalf, sum), dHalf, sums + 8 * y + z); // saturates
        }
    }
    for (int x = 0; x < 8; ++x) {
        const auto beyond = hn::Set(d16, int16_t(ball.most - ball.ofX[x] + 1));
        uint8_t bytes[16]; // of bits, byte y; room for what a narrow store may write beyond
        for (std::size_t i = 0; i < 64; i += hn::Lanes(d16)) {
            hn::StoreMaskBits(d16, hn::Lt(hn::Load(d16, sums + i), beyond), bytes + i / 8);
        }
        uint64_t word = 0;
        for (int y = 0; y < 8; ++y) word |= uint64_t(bytes[y]) << (8 * y);
        words[x] |= word;
    }
#endif
}

/// The three weights go to the largest, middle and smallest of three coordinates. For each of the
/// 64 (y, z) of a leaf, the larger and the smaller of the two are computed once.
void orNormBall(
    const int64_t center[3], const Distance& norm, int64_t limit, int shift, uint64_t words[8])
{
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::CappedTag<int32_t, 8> d32;
    int32_t apart[3][8];
    for (int a = 0; a < 3; ++a) {
        for (int i = 0; i < 8; ++i) apart[a][i] = int32_t(std::abs((i << shift) - center[a]));
    }
    HWY_ALIGN int32_t larger[64], smaller[64];
    for (int i = 0; i < 64; ++i) {
        larger[i] = std::max(apart[1][i >> 3], apart[2][i & 7]);
        smaller[i] = std::min(apart[1][i >> 3], apart[2][i & 7]);
    }
    const auto w1 = hn::Set(d32, norm.face()), w2 = hn::Set(d32, norm.edge() - norm.face()),
               w3 = hn::Set(d32, norm.corner() - norm.edge()),
               beyond = hn::Set(d32, int32_t(limit + 1));
    for (int x = 0; x < 8; ++x) {
        const auto dx = hn::Set(d32, apart[0][x]);
        uint64_t word = 0;
        for (std::size_t i = 0; i < 64; i += hn::Lanes(d32)) {
            const auto high = hn::Load(d32, larger + i), low = hn::Load(d32, smaller + i);
            const auto middle = hn::Max(low, hn::Min(high, dx));
            const auto value = hn::Add(hn::Mul(w1, hn::Max(high, dx)),
                hn::Add(hn::Mul(w2, middle), hn::Mul(w3, hn::Min(low, dx))));
            uint8_t bits[8] = {};
            hn::StoreMaskBits(d32, hn::Lt(value, beyond), bits);
            word |= uint64_t(bits[0]) << i;
        }
        words[x] |= word;
    }
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace openvdb_spheretree::detail {

HWY_EXPORT(orBall);
HWY_EXPORT(orNormBall);

namespace {

constexpr uint64_t kEveryLane = 0x0001000100010001;
constexpr uint64_t kTopBits = kEveryLane << 15;

/// Eight values below 2^15, of z = 0...3 and 4...7, lowest lane first.
struct Row {
    uint64_t low, high;
};

Row rowOf(const int32_t terms[8], int32_t added)
{
    const auto clamp = [](int32_t value) { return uint64_t(std::max(0, std::min(value, 32767))); };
    Row row{0, 0};
    for (int z = 0; z < 4; ++z) {
        row.low |= clamp(terms[z] + added) << (16 * z);
        row.high |= clamp(terms[z + 4] + added) << (16 * z);
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

void orBallIntoLeafPortable(const int64_t center[3], int64_t radiusSq, int shift, uint64_t words[8])
{
    const BallTerms ball(center, radiusSq, shift);
    Row rows[8];
    for (int y = 0; y < 8; ++y) rows[y] = rowOf(ball.ofZ, ball.ofY[y] - ball.least);
    for (int x = 0; x < 8; ++x) {
        const uint64_t limits = uint64_t(ball.most - ball.ofX[x]) * kEveryLane;
        for (int y = 0; y < 8; ++y) words[x] |= atMost(rows[y], limits) << (8 * y);
    }
}

void orBallIntoLeaf(const int64_t center[3], int64_t radiusSq, int shift, uint64_t words[8])
{
    HWY_DYNAMIC_DISPATCH(orBall)(center, radiusSq, shift, words);
}

void orNormBallIntoLeaf(
    const int64_t center[3], const Distance& norm, int64_t limit, int shift, uint64_t words[8])
{
    HWY_DYNAMIC_DISPATCH(orNormBall)(center, norm, limit, shift, words);
}

} // namespace openvdb_spheretree::detail

#endif // HWY_ONCE
