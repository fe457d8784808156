// SPDX-License-Identifier: Apache-2.0
/// @file TestCompressedRows.cc
/// @brief Every item stands in its own row, in the order in which it came.

#include <openvdb_spheretree/base/CompressedRows.h>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace openvdb_spheretree;

std::vector<int32_t> listOf(const NodeSpan& row) { return {row.begin(), row.end()}; }

TEST(CompressedRows, ListIndicesByRowInAscendingOrder)
{
    const CompressedRows rows = compressedRows({2, 0, 2, 3, 0, 2}, 4);
    ASSERT_EQ(rows.rowCount(), 4u);
    EXPECT_EQ(listOf(rows[0]), (std::vector<int32_t>{1, 4}));
    EXPECT_EQ(listOf(rows[1]), std::vector<int32_t>{});
    EXPECT_EQ(listOf(rows[2]), (std::vector<int32_t>{0, 2, 5}));
    EXPECT_EQ(listOf(rows[3]), std::vector<int32_t>{3});
}

TEST(CompressedRows, OfNothingAreEmpty)
{
    const CompressedRows rows = compressedRows({}, 2);
    EXPECT_EQ(rows.rowCount(), 2u);
    EXPECT_TRUE(rows[0].empty());
    EXPECT_TRUE(rows[1].empty());
    EXPECT_EQ(compressedRows({}, 0).rowCount(), 0u);
}

TEST(CompressedRows, MatchAVectorOfVectors)
{
    std::mt19937 random(1);
    for (int trial = 0; trial < 100; ++trial) {
        const std::size_t count = 1 + random() % 20, items = random() % 100;
        std::vector<std::vector<int32_t>> expected(count);
        std::vector<std::pair<int32_t, int32_t>> pairs;
        for (std::size_t i = 0; i < items; ++i) {
            pairs.emplace_back(random() % count, int32_t(random() % 1000));
            expected[std::size_t(pairs.back().first)].push_back(pairs.back().second);
        }
        const CompressedRows rows = compressedRows(
            items, count, [&](std::size_t i) { return pairs[i].first; },
            [&](std::size_t i) { return pairs[i].second; });
        ASSERT_EQ(rows.rowCount(), count);
        for (std::size_t r = 0; r < count; ++r) EXPECT_EQ(listOf(rows[int32_t(r)]), expected[r]);
    }
}

} // namespace
