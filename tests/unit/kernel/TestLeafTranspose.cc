// SPDX-License-Identifier: Apache-2.0
/// @file TestLeafTranspose.cc
/// @brief Values of a leaf transposed, and the largest of them, against plain loops.

#include <openvdb_spheretree/kernel/LargestValue.h>
#include <openvdb_spheretree/kernel/LeafRows.h>
#include <openvdb_spheretree/kernel/LeafTranspose.h>

#include <gtest/gtest.h>
#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace {

using namespace openvdb_spheretree;

template <typename T>
void expectTranspositions()
{
    alignas(64) std::array<T, kLeafVoxels> rows, result, expected;
    for (int i = 0; i < kLeafVoxels; ++i) rows[i] = T(i * 131 + 3); // 16 bits of any value
    detail::swapRows(rows.data(), result.data());
    for (int u = 0; u < 8; ++u) {
        for (int x = 0; x < 8; ++x) {
            for (int v = 0; v < 8; ++v) {
                ASSERT_EQ(result[64 * v + 8 * x + u], rows[64 * u + 8 * x + v]);
            }
        }
    }
    detail::rowsZToLeaf(rows.data(), result.data());
    detail::rowsToLeaf(Axis::Z, rows.data(), expected.data());
    ASSERT_EQ(result, expected);
    result.fill(0);
    detail::streamRowsZToLeaf(rows.data(), result.data());
    hwy::FlushStream();
    ASSERT_EQ(result, expected);
    alignas(64) std::array<int32_t, kLeafVoxels> wide{}, expectedWide;
    std::copy(expected.begin(), expected.end(), expectedWide.begin());
    detail::streamRowsZToLeaf(rows.data(), wide.data());
    hwy::FlushStream();
    ASSERT_EQ(wide, expectedWide);
    detail::streamRowsYToLeaf(rows.data(), result.data());
    hwy::FlushStream();
    detail::rowsToLeaf(Axis::Y, rows.data(), expected.data());
    ASSERT_EQ(result, expected);
}

TEST(LeafTranspose, IsThatOfPlainLoops)
{
    ASSERT_NO_FATAL_FAILURE(expectTranspositions<int8_t>());
    ASSERT_NO_FATAL_FAILURE(expectTranspositions<uint16_t>());
    ASSERT_NO_FATAL_FAILURE(expectTranspositions<uint32_t>());
    ASSERT_NO_FATAL_FAILURE(expectTranspositions<int32_t>());
    ASSERT_NO_FATAL_FAILURE(expectTranspositions<int64_t>());
}

template <typename T>
void expectLargest(T value)
{
    alignas(64) std::array<T, 128> values;
    for (std::size_t at = 0; at < values.size(); ++at) {
        values.fill(T(value - 1));
        values[at] = value;
        ASSERT_EQ(detail::largestValue(values.data(), values.size()), value) << at;
    }
    ASSERT_EQ(detail::largestValue(values.data(), 64), uint32_t(value - 1));
    ASSERT_EQ(detail::largestValue(values.data(), 0), 0u);
}

TEST(LargestValue, IsFoundWhereverItIs)
{
    ASSERT_NO_FATAL_FAILURE(expectLargest<uint16_t>(1));
    ASSERT_NO_FATAL_FAILURE(expectLargest<uint16_t>(65535));
    ASSERT_NO_FATAL_FAILURE(expectLargest<uint32_t>(70000));
    ASSERT_NO_FATAL_FAILURE(expectLargest<uint32_t>(UINT32_MAX));
}

} // namespace
