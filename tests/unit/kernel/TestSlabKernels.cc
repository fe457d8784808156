// SPDX-License-Identifier: Apache-2.0
/// @file TestSlabKernels.cc
/// @brief What slabs are made of: gaps along x, rows, transpositions, targets of offsets and the order
/// of balls, against plain loops.

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/kernel/LargestValue.h>
#include <openvdb_spheretree/kernel/LeafTranspose.h>
#include <openvdb_spheretree/kernel/OffsetBits.h>
#include <openvdb_spheretree/slab/SlabRows.h>
#include <openvdb_spheretree/slab/XGaps.h>
#include <openvdb_spheretree/voxel/SlabOrder.h>

#include <hwy/cache_control.h>

#include <array>

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

TEST(SlabRows, KeepZerosAroundRunsThatDoNotOverlap)
{
    for (uint32_t seed = 0; seed < 20; ++seed) {
        const LeafLayout layout(*maskOf(randomObject(seed).voxels));
        slab::SlabRows<int32_t> rows;
        for (uint32_t index = 0; index < layout.slabCount(); ++index) {
            for (const Axis axis : {Axis::Y, Axis::Z}) {
                rows.open(layout, index, axis);
                const LeafLayout::Slab slab = layout.slab(index);
                for (uint32_t leaf = slab.begin; leaf < slab.end; ++leaf) {
                    std::fill_n(rows.ofLeaf(leaf), kLeafVoxels, int32_t(leaf) + 1);
                }
                const LeafLayout::Slab runs = layout.runsOfSlab(axis, index);
                for (uint32_t i = runs.begin; i < runs.end; ++i) {
                    const LeafLayout::Run run = layout.run(axis, i);
                    const int32_t* row = rows.ofRun(i);
                    ASSERT_TRUE(std::all_of(row - 64, row, [](int32_t v) { return v == 0; }));
                    for (uint32_t k = 0; k < run.count; ++k, row += kLeafVoxels) {
                        ASSERT_EQ(row, rows.ofLeaf(run.leaves[k]));
                        ASSERT_EQ(row[0], int32_t(run.leaves[k]) + 1);
                        ASSERT_EQ(row[kLeafVoxels - 1], int32_t(run.leaves[k]) + 1);
                    }
                    ASSERT_TRUE(std::all_of(row, row + 64, [](int32_t v) { return v == 0; }));
                }
            }
        }
    }
}

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

TEST(BallOrder, IsThatOfCoordinates)
{
    for (uint32_t seed = 0; seed < 20; ++seed) {
        const Voxels voxels = randomObject(seed).voxels;
        const LeafLayout layout(*maskOf(voxels));
        Voxels ordered;
        for (uint32_t index = 0; index < layout.slabCount(); ++index) {
            const LeafLayout::Slab slab = layout.slab(index);
            const LeafMask* marks = &layout.mask(slab.begin);
            const std::size_t before = ordered.size();
            ordered.resize(before + detail::countMarks(marks, slab.size()));
            detail::visitWithPlaces(
                layout, index, marks, [&](uint32_t leaf, uint32_t offset, std::size_t place) {
                    ordered.at(before + place) = layout.voxel(leaf, offset);
                });
        }
        Voxels sorted(voxels);
        std::sort(sorted.begin(), sorted.end());
        sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
        ASSERT_EQ(ordered, sorted) << seed;
    }
}

} // namespace
