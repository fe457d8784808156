// SPDX-License-Identifier: Apache-2.0
/// @file TestOffsetBits.cc
/// @brief The targets of offsets from voxel to voxel, marked and followed, against plain loops.

#include <openvdb_spheretree/kernel/OffsetBits.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include "support/RandomObjects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// Offsets from some rows of a column, which may lead to all others.
template <typename Offset>
void expectRowTargets(int most, double density, Random& random)
{
    constexpr int kRows = 40, kFirst = 8, kLast = 32;
    std::array<Offset, kRows * 64> offsets{};
    std::array<uint64_t, kRows> on{}, marks{}, expected{};
    for (int row = kFirst; row < kLast; ++row) {
        for (int lane = 0; lane < 64; ++lane) {
            const int target = std::max(0, std::min(kRows - 1, row + random.between(-most, most)));
            offsets[row * 64 + lane] = Offset(target - row);
            if (!random.chance(density)) continue;
            on[row] |= uint64_t(1) << lane;
            expected[target] |= uint64_t(1) << lane;
        }
    }
    detail::markRowTargets(&offsets[kFirst * 64], &on[kFirst], kLast - kFirst, &marks[kFirst]);
    ASSERT_EQ(marks, expected);
}

/// The offsets that are worth following, one by one.
template <typename Offset>
detail::FreshOffsets freshOneByOne(
    const std::array<Offset, kLeafVoxels>& offsets, Axis axis, LeafMask mask)
{
    const uint32_t shift = 6 - 3 * uint32_t(axis);
    detail::FreshOffsets fresh{};
    for (uint32_t k = 0; k < kLeafVoxels; ++k) {
        if (!mask.isOn(k)) continue;
        const uint32_t before = k - (1u << shift);
        const bool hasBefore = (k >> shift & 7) > 0 && mask.isOn(before);
        if (hasBefore && offsets[before] == offsets[k] + 1) continue;
        (offsets[k] == 0 ? fresh.stay : fresh.go)[k >> 6] |= uint64_t(1) << (k & 63);
    }
    return fresh;
}

template <typename Offset>
void expectFresh(Axis axis, Random& random)
{
    std::array<Offset, kLeafVoxels> offsets;
    LeafMask mask{};
    for (int k = 0; k < kLeafVoxels; ++k) {
        offsets[k] = Offset(random.chance(0.1) ? random.between(-128, 127) : random.between(-1, 1));
        if (k >> 6 == 3 || random.chance(0.3)) continue;
        mask[k >> 6] |= uint64_t(1) << (k & 63);
    }
    const detail::FreshOffsets actual = detail::freshOffsets(offsets.data(), axis, mask);
    const detail::FreshOffsets expected = freshOneByOne(offsets, axis, mask);
    ASSERT_EQ(actual.stay, expected.stay);
    ASSERT_EQ(actual.go, expected.go);
}

TEST(OffsetBits, AreFollowedOnceWhereNeighboursShareTargets)
{
    Random random(5);
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
        for (int i = 0; i < 10; ++i) {
            ASSERT_NO_FATAL_FAILURE(expectFresh<int8_t>(axis, random));
            ASSERT_NO_FATAL_FAILURE(expectFresh<int16_t>(axis, random));
        }
    }
}

TEST(OffsetBits, MarkTheTargetOfEveryLaneThatIsOn)
{
    Random random(4);
    for (const int most : {0, 1, 3, 40}) {
        for (const double density : {0.0, 0.02, 0.5, 1.0}) {
            ASSERT_NO_FATAL_FAILURE(expectRowTargets<int8_t>(most, density, random));
            ASSERT_NO_FATAL_FAILURE(expectRowTargets<int16_t>(most, density, random));
        }
    }
}

} // namespace
