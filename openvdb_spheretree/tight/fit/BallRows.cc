// SPDX-License-Identifier: Apache-2.0
#include "BallRows.h"

#include "CostWindow.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/tight/fit/BallRows.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::tight {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kMostRows = 1024; // of a slice

/// Where the rows of one slice enter and leave the ball.
struct Slice {
    int32_t y0, y1; ///< inclusive; none where y0 > y1
    HWY_ALIGN int32_t z0[kMostRows + 32];
    HWY_ALIGN int32_t z1[kMostRows + 32];
};

/// No window is as large; keeps the chords of far and huge balls in range.
constexpr float kFar = float(1 << 26);

/// The samples in the ball along an axis, of those in [0, size); none where first > last.
struct Range {
    int32_t first, last;

    /// @param halfChord  of the ball, along the axis
    Range(float center, float halfChord, int32_t size)
    {
        const auto clamped = [](float at) { return int32_t(std::max(-kFar, std::min(kFar, at))); };
        first = std::max(0, (clamped(center - std::floor(halfChord)) + 15) >> 4);
        last = std::min(size - 1, clamped(center + std::floor(halfChord)) >> 4);
    }
};

/// Where rows of a slice enter and leave the ball: one for each lane, the first of them row y.
/// @param rest  what is left of the squared radius in the slice
template <class DI>
HWY_INLINE void chordsOf(
    DI di, const LocalBall& ball, float rest, int32_t y, hn::Vec<DI>& first, hn::Vec<DI>& last)
{
    const hn::RebindToFloat<DI> df;
    const auto far = hn::Set(df, kFar), low = hn::Set(df, -kFar), z = hn::Set(df, ball.z);
    const auto at = hn::ConvertTo(df, hn::ShiftLeft<4>(hn::Iota(di, y)));
    const auto apart = hn::Sub(at, hn::Set(df, ball.y));
    const auto left = hn::Sub(hn::Set(df, rest), hn::Mul(apart, apart));
    const auto half = hn::Floor(hn::Sqrt(hn::Max(left, hn::Zero(df))));
    const auto from = hn::ConvertTo(di, hn::Max(low, hn::Min(far, hn::Sub(z, half))));
    const auto to = hn::ConvertTo(di, hn::Max(low, hn::Min(far, hn::Add(z, half))));
    first = hn::ShiftRight<4>(hn::Add(from, hn::Set(di, 15)));
    last = hn::ShiftRight<4>(to);
}

/// @param sizeY  rows there are: the slice is clipped to [0, sizeY)
void sliceOf(const LocalBall& ball, int32_t x, int32_t sizeY, Slice& slice)
{
    const hn::CappedTag<int32_t, 16> di;
    const float dx = float(16 * x) - ball.x, rest = ball.radiusSq - dx * dx;
    slice.y0 = 0;
    slice.y1 = -1;
    if (rest < 0) return;
    const Range rows(ball.y, std::sqrt(rest), sizeY);
    slice.y0 = rows.first;
    slice.y1 = rows.last;
    auto first = hn::Zero(di), last = first;
    for (int32_t y = slice.y0; y <= slice.y1; y += int32_t(hn::Lanes(di))) {
        chordsOf(di, ball, rest, y, first, last);
        hn::StoreU(first, di, slice.z0 + (y - slice.y0));
        hn::StoreU(last, di, slice.z1 + (y - slice.y0));
    }
}

/// @return the bits first to last of a row, as far as they are in word @a word of it; some are.
HWY_INLINE uint64_t wordMask(int32_t word, int32_t first, int32_t last)
{
    uint64_t mask = ~uint64_t(0);
    if (first > 64 * word) mask &= ~uint64_t(0) << (first & 63);
    if (last < 64 * word + 63) mask &= ~uint64_t(0) >> (63 - (last & 63));
    return mask;
}

/// Calls body(x, y, row, z0, z1) for the rows of a window in a ball; z0 to z1 are in the window.
template <typename Body>
HWY_INLINE void forEachRow(const BitRows& rows, const LocalBall& ball, const Body& body)
{
    if (ball.radiusSq < 0) return;
    Slice slice;
    const Range slices(ball.x, std::sqrt(ball.radiusSq), rows.size[0]);
    for (int32_t x = slices.first; x <= slices.last; ++x) {
        sliceOf(ball, x, rows.size[1], slice);
        std::size_t row = std::size_t(x) * std::size_t(rows.size[1]) + std::size_t(slice.y0);
        for (int32_t y = slice.y0; y <= slice.y1; ++y, ++row) {
            const int32_t z0 = std::max(0, slice.z0[y - slice.y0]);
            const int32_t z1 = std::min(rows.size[2] - 1, slice.z1[y - slice.y0]);
            if (z0 <= z1) body(x, y, row * std::size_t(rows.words), z0, z1);
        }
    }
}

int64_t countBits(const BitRows& rows, const LocalBall& ball)
{
    int64_t sum = 0;
    forEachRow(rows, ball, [&](int32_t, int32_t, std::size_t row, int32_t z0, int32_t z1) {
        for (int32_t w = z0 >> 6; w <= z1 >> 6; ++w) {
            sum += __builtin_popcountll(rows.bits[row + std::size_t(w)] & wordMask(w, z0, z1));
        }
    });
    return sum;
}

/// Calls body(first, last) for the runs of bits between z0 and z1 of a row.
template <typename Body>
HWY_INLINE void forEachRun(const uint64_t* row, int32_t z0, int32_t z1, const Body& body)
{
    int32_t first = z0, beyond = z0; // the run so far: none
    for (int32_t w = z0 >> 6; w <= z1 >> 6; ++w) {
        uint64_t word = row[w] & wordMask(w, z0, z1);
        while (word) {
            const int32_t begin = __builtin_ctzll(word);
            const uint64_t gaps = ~(word >> begin); // only zero where all 64 bits are set
            const int32_t length = gaps ? __builtin_ctzll(gaps) : 64;
            if (64 * w + begin != beyond) {
                if (first < beyond) body(first, beyond - 1);
                first = 64 * w + begin;
            }
            beyond = 64 * w + begin + length;
            word = begin + length < 64 ? word & ~uint64_t(0) << (begin + length) : 0;
        }
    }
    if (first < beyond) body(first, beyond - 1);
}

void collectBits(const BitRows& rows, const LocalBall& ball, std::vector<CostRun>& found)
{
    forEachRow(rows, ball, [&](int32_t x, int32_t y, std::size_t row, int32_t z0, int32_t z1) {
        const float dx = float(16 * x) - ball.x, dy = float(16 * y) - ball.y;
        const float rowSq = dx * dx + dy * dy;
        forEachRun(rows.bits + row, z0, z1, [&](int32_t first, int32_t last) {
            const float below = float(16 * first) - ball.z, above = ball.z - float(16 * last);
            const float dz = std::max(0.0f, std::max(below, above));
            found.emplace_back(float(16 * x), float(16 * y), first, last, rowSq + dz * dz);
        });
    });
}

/// Clears word @a word of the rows y0 to y1 of slice x, as far as they are in a ball.
void clearWords(uint64_t* bits, const int32_t size[3], int32_t words, const LocalBall& ball,
    int32_t x, int32_t y0, int32_t y1, int32_t word)
{
    const hn::CappedTag<uint64_t, 8> d64;
    const hn::RebindToSigned<decltype(d64)> di64;
    const hn::Rebind<int32_t, decltype(d64)> di;
    const auto lanes = int32_t(hn::Lanes(d64));
    const float dx = float(16 * x) - ball.x, rest = ball.radiusSq - dx * dx;
    const auto begin = hn::Set(di, 64 * word), none = hn::Zero(di), last = hn::Set(di, 63);
    const auto all = hn::Set(d64, ~uint64_t(0));
    const auto wide = [&](auto v) { return hn::BitCast(d64, hn::PromoteTo(di64, v)); };
    HWY_ALIGN uint64_t kept[8];
    auto first = none, end = none;
    for (int32_t y = y0; y <= y1; y += lanes) {
        chordsOf(di, ball, rest, y, first, end);
        const auto lo = hn::Max(hn::Sub(first, begin), none);
        const auto hi = hn::Min(hn::Sub(end, begin), last);
        const auto held = hn::And(hn::Shl(all, wide(hn::Min(lo, last))),
            hn::Shr(all, wide(hn::Sub(last, hn::Max(hi, none)))));
        // All ones, or none where the chord does not meet the word.
        const auto meets = hn::IfThenZeroElse(hn::Gt(lo, hi), hn::Set(di, -1));
        hn::Store(hn::Not(hn::And(held, wide(meets))), d64, kept);
        uint64_t* row = bits
            + (std::size_t(x) * std::size_t(size[1]) + std::size_t(y)) * std::size_t(words)
            + std::size_t(word);
        const int32_t rows = std::min(lanes, y1 - y + 1);
        for (int32_t i = 0; i < rows; ++i, row += words) *row &= kept[i];
    }
}

void clearBits(uint64_t* bits, const int32_t size[3], int32_t words, const LocalBall& ball)
{
    if (ball.radiusSq < 0) return;
    const float reach = std::sqrt(ball.radiusSq);
    const Range slices(ball.x, reach, size[0]), samples(ball.z, reach, 64 * words);
    for (int32_t x = slices.first; x <= slices.last; ++x) {
        const float dx = float(16 * x) - ball.x, rest = ball.radiusSq - dx * dx;
        if (rest < 0) continue;
        const Range rows(ball.y, std::sqrt(rest), size[1]);
        for (int32_t w = samples.first >> 6; w <= samples.last >> 6; ++w) {
            clearWords(bits, size, words, ball, x, rows.first, rows.last, w);
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace openvdb_spheretree::tight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace openvdb_spheretree::tight {

HWY_EXPORT(countBits);
HWY_EXPORT(collectBits);
HWY_EXPORT(clearBits);

int64_t countBits(const BitRows& rows, const LocalBall& ball)
{
    return HWY_DYNAMIC_DISPATCH(countBits)(rows, ball);
}

void collectBits(const BitRows& rows, const LocalBall& ball, std::vector<CostRun>& found)
{
    HWY_DYNAMIC_DISPATCH(collectBits)(rows, ball, found);
}

void clearBits(uint64_t* bits, const int32_t size[3], int32_t words, const LocalBall& ball)
{
    HWY_DYNAMIC_DISPATCH(clearBits)(bits, size, words, ball);
}

} // namespace openvdb_spheretree::tight

#endif // HWY_ONCE
