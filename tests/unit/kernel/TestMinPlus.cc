// SPDX-License-Identifier: Apache-2.0
/// @file TestMinPlus.cc
/// @brief The kernel of the distance transform against plain loops.

#include "support/RandomObjects.h"

#include <openvdb_spheretree/kernel/LeafRows.h>
#include <openvdb_spheretree/kernel/MinPlus.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace {

using namespace openvdb_spheretree::detail;
using spheretree_test::Random;

/// Values of 64 lines, row by row, within what a width holds.
using Rows = std::vector<uint32_t>;

Rows makeRows(int rows, Random& random, uint32_t (*value)(Random&, int row, int lane))
{
    Rows result;
    for (int row = 0; row < rows; ++row) {
        for (int lane = 0; lane < kLanes; ++lane) result.push_back(value(random, row, lane));
    }
    return result;
}

/// The least of in(j) + (i - j)^2 over all rows and the background before and behind them.
Rows naiveMinPlus(const Rows& in)
{
    const int rows = int(in.size()) / kLanes;
    Rows out(in.size());
    for (int lane = 0; lane < kLanes; ++lane) {
        for (int64_t i = 0; i < rows; ++i) {
            int64_t least = std::min((i + 1) * (i + 1), (rows - i) * (rows - i));
            for (int64_t j = 0; j < rows; ++j) {
                least = std::min(least, int64_t(in[j * kLanes + lane]) + (i - j) * (i - j));
            }
            out[i * kLanes + lane] = uint32_t(least);
        }
    }
    return out;
}

template <typename T>
Rows runMinPlus(const Rows& in)
{
    const int rows = int(in.size()) / kLanes;
    if (rows <= 0) return {};
    RowBuffer<T> inBuffer, outBuffer;
    T* inRows = inBuffer.rows(rows, 1);
    T* outRows = outBuffer.rows(rows);
    for (std::size_t i = 0; i < in.size(); ++i) inRows[i] = T(in[i]);
    EnvelopeScratch scratch;
    minPlus(inRows, outRows, rows, scratch);
    return Rows(outRows, outRows + in.size());
}

struct Distribution {
    const char* name;
    uint32_t largest;
    uint32_t (*value)(Random&, int row, int lane);
};

const Distribution kDistributions[] = {
    {"all zero", 0, [](Random&, int, int) { return 0u; }},
    {"zero or one", 1, [](Random& r, int, int) { return uint32_t(r.between(0, 1)); }},
    {"small", 30, [](Random& r, int, int) { return uint32_t(r.between(0, 30)); }},
    {"equal", 400, [](Random&, int, int) { return 400u; }},
    {"squares", 254 * 254,
        [](Random& r, int, int) {
            const int root = r.between(0, 254);
            return uint32_t(root * root);
        }},
    {"some lanes zero", 65000,
        [](Random& r, int, int lane) {
            return lane % 3 == 0 ? 0u : uint32_t(r.between(0, 65000));
        }},
    {"few zeros among the largest", kNarrowMax,
        [](Random& r, int, int) { return r.chance(0.02) ? 0u : kNarrowMax; }},
    {"only the largest", kNarrowMax, [](Random&, int, int) { return kNarrowMax; }},
    {"blocks of small and large", kNarrowMax,
        [](Random& r, int row, int lane) {
            return row / 24 % 2 ? uint32_t(r.between(0, 9)) : uint32_t(60000 + lane * 7 + row % 8);
        }},
    {"staircase", 65000,
        [](Random&, int row, int lane) { return uint32_t((row * 37 + lane * 11) % 255 * 255); }},
};

constexpr int kRowCounts[] = {8, 16, 24, 40, 64, 72, 128, 200, 256, 512};

TEST(MinPlus, MatchesPlainLoopsIn16Bits)
{
    Random random(1);
    for (const Distribution& distribution : kDistributions) {
        for (int rows : kRowCounts) {
            const Rows in = makeRows(rows, random, distribution.value);
            ASSERT_TRUE(runMinPlus<uint16_t>(in) == naiveMinPlus(in))
                << distribution.name << ", rows " << rows;
        }
    }
}

TEST(MinPlus, MatchesPlainLoopsIn32Bits)
{
    Random random(2);
    for (const Distribution& distribution : kDistributions) {
        for (int rows : kRowCounts) {
            const Rows in = makeRows(rows, random, distribution.value);
            ASSERT_TRUE(runMinPlus<uint32_t>(in) == naiveMinPlus(in))
                << distribution.name << ", rows " << rows;
        }
    }
}

TEST(MinPlus, MatchesPlainLoopsOnValuesBeyond16Bits)
{
    Random random(3);
    const auto anything = [](Random& r, int, int) { return uint32_t(r.between(0, int(kWideMax))); };
    const auto lumps = [](Random& r, int row, int) {
        return row / 40 % 2 ? kWideMax : uint32_t(r.between(0, 200000));
    };
    for (int rows : kRowCounts) {
        const Rows far = makeRows(rows, random, anything), near = makeRows(rows, random, lumps);
        ASSERT_TRUE(runMinPlus<uint32_t>(far) == naiveMinPlus(far)) << rows;
        ASSERT_TRUE(runMinPlus<uint32_t>(near) == naiveMinPlus(near)) << rows;
    }
}

/// Around one row of a block of 8 all values are k^2 + 1: a zero at distance k is better by 1, and
/// no row beyond it is. Elsewhere are values too small to reach as far.
template <typename T>
void expectReach(int k)
{
    constexpr int kRows = 128;
    for (int row = 48; row < 56; ++row) {
        for (int zero : {row - k, row + k}) {
            Rows in(kRows * kLanes, 1);
            for (int lane = 0; lane < kLanes; ++lane) {
                for (int j = row - k; j <= row + k; ++j) in[j * kLanes + lane] = k * k + 1;
                in[zero * kLanes + lane] = lane % 2 == 0 ? 0 : k * k + 1;
            }
            ASSERT_TRUE(runMinPlus<T>(in) == naiveMinPlus(in)) << "row " << row << ", k " << k;
        }
    }
}

TEST(MinPlus, ARowIsReachedFromAsFarAsItIsBetter)
{
    for (int k : {1, 2, 3, 4, 5, 6, 11, 30}) {
        expectReach<uint16_t>(k);
        expectReach<uint32_t>(k);
    }
}

/// The values of a slab whose lines are all alike: the distance to the nearest end, at most @a
/// root.
template <typename T>
void expectSlab(int rows, int64_t root)
{
    const Rows in(std::size_t(rows) * kLanes, uint32_t(root * root));
    const Rows out = runMinPlus<T>(in);
    for (int64_t row = 0; row < rows; ++row) {
        const int64_t steps = std::min({row + 1, rows - row, root});
        for (int lane = 0; lane < kLanes; ++lane) {
            ASSERT_EQ(int64_t(out[row * kLanes + lane]), steps * steps) << rows << ", row " << row;
        }
    }
}

TEST(MinPlus, LinesMayBeLongerThanTheLargestRadius)
{
    expectSlab<uint16_t>(1000, 255);
    expectSlab<uint16_t>(1000, 6);
    expectSlab<uint32_t>(1000, 46340);
    expectSlab<uint32_t>(8 * 12000, 46340);
}

/// Zeros twice as far apart as 32 bits allow, elsewhere in every line; between them the largest
/// values, with the largest penalties on them.
TEST(MinPlus, SumsOfTheLargestValuesAndPenaltiesFit)
{
    constexpr int kRows = 8 * 11720;
    constexpr int64_t kRoot = 46339;
    Rows in(std::size_t(kRows) * kLanes, kWideMax), expected(in.size());
    for (int lane = 0; lane < kLanes; ++lane) {
        const int64_t first = 500 + lane, second = first + 2 * kRoot;
        in[first * kLanes + lane] = in[second * kLanes + lane] = 0;
        for (int64_t row = 0; row < kRows; ++row) {
            const int64_t steps =
                std::min({row + 1, kRows - row, std::abs(row - first), std::abs(row - second)});
            expected[row * kLanes + lane] = uint32_t(steps * steps);
        }
    }
    EXPECT_TRUE(runMinPlus<uint32_t>(in) == expected);
}

TEST(MinPlus, RowNumbersMayExceed16Bits)
{
    for (int64_t root : {2, 6, 255}) {
        expectSlab<uint16_t>(8 * 4097, root);
        expectSlab<uint16_t>(8 * 8300, root);
    }
    expectSlab<uint32_t>(8 * 8300, 6);
}

TEST(MinPlus, OneScratchServesRunsOfAnyLength)
{
    Random random(4);
    EnvelopeScratch scratch;
    RowBuffer<uint16_t> inBuffer, outBuffer;
    for (int rows : {256, 8, 64, 512, 16}) {
        const Rows in = makeRows(rows, random, kDistributions[4].value);
        uint16_t* inRows = inBuffer.rows(rows, 1);
        uint16_t* outRows = outBuffer.rows(rows);
        std::copy(in.begin(), in.end(), inRows);
        minPlus(inRows, outRows, rows, scratch);
        ASSERT_TRUE(Rows(outRows, outRows + in.size()) == naiveMinPlus(in)) << rows;
    }
}

} // namespace
