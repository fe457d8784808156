// SPDX-License-Identifier: Apache-2.0
/// @file TestLaneBits.cc
/// @brief Comparisons of 64 values at once, against one after the other.

#include "support/RandomObjects.h"

#include <openvdb_spheretree/kernel/LaneBits.h>

#include <gtest/gtest.h>

#include <array>

using namespace openvdb_spheretree::detail;
using namespace spheretree_test;

TEST(LaneBits, AreThoseOfOneValueAfterTheOther)
{
    Random random(11);
    for (int round = 0; round < 200; ++round) {
        std::array<int32_t, kLaneMargin + 64> a, b;
        for (int32_t& value : a) value = random.between(0, round % 3);
        for (int32_t& value : b) value = random.between(0, round % 3);
        const int32_t *rowA = a.data() + kLaneMargin, *rowB = b.data() + kLaneMargin;
        uint64_t equal = 0, alongY = 0, alongZ = 0;
        for (int lane = 0; lane < 64; ++lane) {
            const uint64_t bit = uint64_t(1) << lane;
            if (rowA[lane] == rowB[lane]) equal |= bit;
            if (lane >= 8 && rowA[lane] == rowA[lane - 8]) alongY |= bit;
            if (lane % 8 != 0 && rowA[lane] == rowA[lane - 1]) alongZ |= bit;
        }
        EXPECT_EQ(equalLanes(rowA, rowB), equal);
        EXPECT_EQ(likeBefore(rowA).alongY, alongY);
        EXPECT_EQ(likeBefore(rowA).alongZ, alongZ);
    }
}
