// SPDX-License-Identifier: Apache-2.0
/// @file TestMaxPlus.cc
/// @brief The kernels of the power map against plain loops, on lines as the power map has them: the
/// value of a voxel is at most the squared distance to the next background of its line, because its
/// ball holds no background; the radius of its site is at least that.

#include "support/RandomObjects.h"

#include <openvdb_spheretree/kernel/LeafRows.h>
#include <openvdb_spheretree/kernel/MaxPlus.h>

#include <gtest/gtest.h>

#include <vector>

namespace {

using namespace openvdb_spheretree::detail;
using spheretree_test::Random;

/// A voxel of a line: how well its site covers it, and the site's own radius; 0 for background.
struct Entry {
    int64_t value = 0, siteSq = 0;
    bool operator==(const Entry& o) const { return value == o.value && siteSq == o.siteSq; }
};
using Rows = std::vector<Entry>; // 64 a row

struct Result {
    Rows best;
    std::vector<int> offsets;
};

/// How values lie below the squared distance to the line's next background.
using Value = int64_t (*)(Random&, int64_t most);
/// How often a voxel is background, by lane.
using Background = double (*)(int lane);

void fillLine(Rows& rows, int lane, int64_t largestSq, double rate, Value value, Random& random)
{
    const int count = int(rows.size()) / kLanes;
    std::vector<int64_t> steps(count);
    std::vector<bool> on(count);
    for (int i = 0; i < count; ++i) on[i] = !random.chance(rate);
    for (int64_t i = 0; i < count; ++i) {
        while (i - steps[i] >= 0 && i + steps[i] < count && on[i - steps[i]] && on[i + steps[i]]) {
            ++steps[i];
        }
        if (!on[i]) continue;
        Entry& entry = rows[i * kLanes + lane];
        entry.value = std::max<int64_t>(1, value(random, std::min(steps[i] * steps[i], largestSq)));
        // Few different radii, so that both tie rules come into play.
        const int64_t more = (largestSq - entry.value) / 3 * random.between(0, 3);
        entry.siteSq = random.chance(0.5) ? entry.value : entry.value + more;
    }
}

Rows makeRows(int count, int64_t largestSq, Background background, Value value, Random& random)
{
    Rows rows(std::size_t(count) * kLanes);
    for (int lane = 0; lane < kLanes; ++lane) {
        fillLine(rows, lane, largestSq, background(lane), value, random);
    }
    return rows;
}

/// The first of the best rows for every voxel that is on.
Result naiveMaxPlus(const Rows& rows)
{
    const int count = int(rows.size()) / kLanes;
    Result result{Rows(rows.size()), std::vector<int>(rows.size())};
    for (int i = 0; i < count; ++i) {
        for (int lane = 0; lane < kLanes; ++lane) {
            const int at = i * kLanes + lane;
            if (rows[at].siteSq == 0) continue;
            Entry best = rows[at];
            int offset = 0;
            for (int j = 0; j < count; ++j) {
                Entry entry = rows[j * kLanes + lane];
                if (entry.siteSq == 0) continue;
                entry.value -= int64_t(i - j) * (i - j);
                const bool equal = entry == best;
                const bool better = entry.value != best.value ? entry.value > best.value
                                                              : entry.siteSq > best.siteSq;
                if (!better && !(equal && j - i < offset)) continue;
                best = entry;
                offset = j - i;
            }
            result.best[at] = best;
            result.offsets[at] = offset;
        }
    }
    return result;
}

template <typename Power>
Result runMaxPlus(const Rows& rows, bool withKeys = true)
{
    using Key = typename Power::Key;
    const int count = int(rows.size()) / kLanes;
    if (count <= 0) return {};
    RowBuffer<Key> inBuffer, outBuffer;
    RowBuffer<typename Power::Offset> offsetBuffer;
    Key* in = inBuffer.rows(count, 1);
    Key* out = outBuffer.rows(count);
    auto* offsets = offsetBuffer.rows(count);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        in[i] = powerKey<Power>(uint32_t(rows[i].value), uint32_t(rows[i].siteSq));
    }
    EnvelopeScratch scratch;
    maxPlus<Power>(in, withKeys ? out : nullptr, offsets, {0, count, count}, scratch);
    Result result{Rows(rows.size()), std::vector<int>(offsets, offsets + rows.size())};
    for (std::size_t i = 0; withKeys && i < rows.size(); ++i) {
        const int64_t value = out[i] >> Power::kShift, siteSq = siteSqOf<Power>(out[i]);
        result.best[i] = {value, siteSq};
        EXPECT_EQ(out[i], powerKey<Power>(uint32_t(value), uint32_t(siteSq)));
    }
    return result;
}

/// The keys and steps of rows whose values are the squared radii.
template <typename Power, typename T>
Result runFirst(const Rows& rows)
{
    const int count = int(rows.size()) / kLanes;
    RowBuffer<T> inBuffer;
    RowBuffer<typename Power::Key> outBuffer;
    RowBuffer<typename Power::Offset> offsetBuffer;
    T* in = inBuffer.rows(count);
    auto* out = outBuffer.rows(count);
    auto* offsets = offsetBuffer.rows(count);
    uint32_t largest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        in[i] = T(rows[i].siteSq);
        largest = std::max(largest, uint32_t(in[i]));
    }
    EnvelopeScratch scratch;
    EXPECT_EQ((firstMaxPlus<Power>(in, out, offsets, count, scratch)), largest);
    Result result{Rows(rows.size()), std::vector<int>(offsets, offsets + rows.size())};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        result.best[i] = {int64_t(out[i] >> Power::kShift), siteSqOf<Power>(out[i])};
    }
    return result;
}

struct {
    const char* name;
    Value value;
} const kValues[] = {
    {"anything", [](Random& r, int64_t most) { return int64_t(r.between(1, int(most))); }},
    {"as large as can be", [](Random&, int64_t most) { return most; }},
    {"one", [](Random&, int64_t) { return int64_t(1); }},
    {"few different ones", [](Random& r, int64_t most) { return most * r.between(0, 4) / 4; }},
    {"at most 9", [](Random& r, int64_t most) { return std::min<int64_t>(most, r.between(1, 9)); }},
    {"large but for a few", [](Random& r, int64_t most) { return r.chance(0.9) ? most : 1; }},
};

struct {
    const char* name;
    Background rate;
} const kBackgrounds[] = {
    {"full lines", [](int) { return 0.0; }},
    {"empty lanes", [](int lane) { return lane % 3 ? 0.01 : 1.0; }},
    {"few cuts", [](int) { return 0.01; }},
    {"every lane another rate", [](int lane) { return lane / 64.0; }},
    {"all background", [](int) { return 1.0; }},
};

constexpr int kRowCounts[] = {8, 16, 24, 72, 128, 200, 512};

template <typename Power>
void expectMatches(int64_t largestSq, uint32_t seed)
{
    Random random(seed);
    for (const auto& value : kValues) {
        for (const auto& background : kBackgrounds) {
            for (int count : kRowCounts) {
                const Rows rows = makeRows(count, largestSq, background.rate, value.value, random);
                const Result expected = naiveMaxPlus(rows), result = runMaxPlus<Power>(rows);
                ASSERT_TRUE(result.best == expected.best && result.offsets == expected.offsets)
                    << "values " << value.name << ", " << background.name << ", rows " << count;
            }
        }
    }
}

/// Up to this size, steps travel in the keys.
constexpr int64_t kSmallSq = 60 * 60;

TEST(MaxPlus, SmallKeysMatchPlainLoopsTiesIncluded)
{
    expectMatches<NarrowPower>(kSmallSq, 5);
    expectMatches<NarrowPower>(kSmallSq + 1, 6);
}

TEST(MaxPlus, NarrowKeysMatchPlainLoopsTiesIncluded)
{
    expectMatches<NarrowPower>(NarrowPower::kMaxRadiusSq, 1);
}

TEST(MaxPlus, WideKeysMatchPlainLoopsTiesIncluded)
{
    expectMatches<WidePower>(NarrowPower::kMaxRadiusSq, 2);
    expectMatches<WidePower>(256 * 256, 3);
}

TEST(MaxPlus, OffsetsAreTheSameWithoutKeys)
{
    Random random(4);
    for (int count : kRowCounts) {
        const Rows rows = makeRows(count, kSmallSq, kBackgrounds[2].rate, kValues[1].value, random);
        const Result expected = naiveMaxPlus(rows);
        EXPECT_EQ(runMaxPlus<NarrowPower>(rows, false).offsets, expected.offsets) << count;
        EXPECT_EQ(runMaxPlus<WidePower>(rows, false).offsets, expected.offsets) << count;
    }
}

TEST(MaxPlus, DistancesAreTheirOwnSites)
{
    Random random(7);
    for (const int64_t largestSq : {kSmallSq, kSmallSq + 1, int64_t(NarrowPower::kMaxRadiusSq)}) {
        for (const int count : {8, 40, 200}) {
            Rows rows = makeRows(count, largestSq, kBackgrounds[2].rate, kValues[0].value, random);
            for (Entry& entry : rows) entry.siteSq = entry.value;
            const Result expected = naiveMaxPlus(rows);
            const Result narrow = runFirst<NarrowPower, uint16_t>(rows);
            const Result wide = runFirst<WidePower, uint32_t>(rows);
            ASSERT_TRUE(narrow.best == expected.best && narrow.offsets == expected.offsets);
            ASSERT_TRUE(wide.best == expected.best && wide.offsets == expected.offsets);
        }
    }
}

TEST(MaxPlus, OnlyWantedRowsAreTouched)
{
    Random random(8);
    constexpr int kCount = 72;
    const Rows rows = makeRows(kCount, kSmallSq, kBackgrounds[2].rate, kValues[0].value, random);
    const Result expected = naiveMaxPlus(rows);
    RowBuffer<int32_t> inBuffer;
    RowBuffer<int8_t> offsetBuffer;
    int32_t* in = inBuffer.rows(kCount, 1);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        in[i] = powerKey<NarrowPower>(uint32_t(rows[i].value), uint32_t(rows[i].siteSq));
    }
    EnvelopeScratch scratch;
    for (const RowRange& wanted : {RowRange{0, 8, kCount}, RowRange{24, 56, kCount},
             RowRange{64, kCount, kCount}, RowRange{8, 8, kCount}}) {
        int8_t* offsets = offsetBuffer.rows(kCount);
        std::fill_n(offsets, rows.size(), int8_t(111));
        maxPlus<NarrowPower>(in, nullptr, offsets, wanted, scratch);
        for (int i = 0; i < kCount * kLanes; ++i) {
            const int row = i / kLanes;
            const bool isWanted = row >= wanted.first && row < wanted.last;
            ASSERT_EQ(int(offsets[i]), isWanted ? expected.offsets[i] : 111) << row;
        }
    }
}

/// One large site in the middle of a line of ones: it owns all that it reaches.
template <typename Power>
void expectOneSite(int64_t radius)
{
    const int count = int(radius + 15) / 8 * 8 * 2;
    const int64_t middle = count / 2;
    Rows rows(std::size_t(count) * kLanes, Entry{1, 1});
    for (int lane = 0; lane < kLanes; ++lane) {
        rows[middle * kLanes + lane] = Entry{radius * radius, radius * radius};
    }
    const Result result = runMaxPlus<Power>(rows);
    for (int64_t row = 0; row < count; ++row) {
        // At radius - 1 and nearer the site's value is above 1; there and beyond, voxels are their
        // own.
        const int64_t step = middle - row;
        const bool owned = std::abs(step) < radius;
        ASSERT_EQ(result.offsets[row * kLanes + 63], owned ? step : 0) << radius << ", row " << row;
    }
}

TEST(MaxPlus, HoldsTheLargestRadiusOfEachWidth)
{
    for (const int64_t radius : {60, 61, 64, 90, 127}) expectOneSite<NarrowPower>(radius);
    expectOneSite<WidePower>(128);
    expectOneSite<WidePower>(32767);
}

template <typename Power>
void expectLongLine()
{
    constexpr int kCount = 8 * 8300;
    Rows rows(std::size_t(kCount) * kLanes);
    for (int64_t row = 0; row < kCount; ++row) {
        const int64_t steps = std::min<int64_t>({row + 1, kCount - row, 40});
        for (int lane = 0; lane < kLanes; ++lane) {
            rows[row * kLanes + lane] = Entry{steps * steps, steps * steps};
        }
    }
    const Result result = runMaxPlus<Power>(rows);
    for (int64_t row = 0; row < kCount; ++row) {
        // Voxels nearer to an end than 40 belong to the first site of full size, the rest to
        // themselves.
        const int64_t site = std::min<int64_t>(std::max<int64_t>(row, 39), kCount - 40);
        ASSERT_EQ(result.offsets[row * kLanes], site - row) << row;
    }
}

TEST(MaxPlus, LinesMayBeLongerThan65536Rows)
{
    expectLongLine<NarrowPower>();
    expectLongLine<WidePower>();
}

} // namespace
