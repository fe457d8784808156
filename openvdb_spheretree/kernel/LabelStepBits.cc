// SPDX-License-Identifier: Apache-2.0
#include "LabelStepBits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/kernel/LabelStepBits.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree {
namespace detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// @return the lanes of a row that pass a test of the vector at each lane.
template <class D, typename Test>
HWY_INLINE uint64_t LanesThat(D d, const Test& test)
{
    uint64_t all = 0;
    for (std::size_t lane = 0; lane < 64; lane += hn::Lanes(d)) {
        uint64_t word = 0;
        hn::StoreMaskBits(d, test(lane), reinterpret_cast<uint8_t*>(&word));
        all |= word << lane;
    }
    return all;
}

template <typename T>
HWY_INLINE uint64_t EqualTo(const T* row, int step)
{
    const hn::CappedTag<T, 64> d;
    const auto value = hn::Set(d, T(step));
    return LanesThat(d, [&](std::size_t lane) { return hn::Eq(hn::LoadU(d, row + lane), value); });
}

/// @param before  of the first lane in use: the 64 values that stand before the row's along the axis
template <typename T>
HWY_INLINE uint64_t EndAsBefore(const T* row, const T* before)
{
    const hn::CappedTag<T, 64> d;
    return LanesThat(d, [&](std::size_t lane) {
        const auto step = hn::LoadU(d, row + lane);
        return hn::Eq(hn::Add(step, hn::Set(d, T(1))), hn::LoadU(d, before + lane));
    });
}

/// Calls visit(x, row, same) for words of @a mask with a voxel: their 64 steps, and which end as the
/// step before them along the axis does.
template <typename T, typename Visit>
HWY_INLINE void ForEachWord(const T* steps, Axis axis, const LeafMask& mask, const Visit& visit)
{
    // Voxels at the leaf's own border have none before them; reading there stays in `firstWord`.
    constexpr std::size_t kMargin = 64;
    T firstWord[kMargin + 64];
    std::fill_n(firstWord, kMargin, T(0));
    std::memcpy(firstWord + kMargin, steps, 64 * sizeof(T));
    const std::size_t stride = std::size_t(64) >> (3 * int(axis));
    constexpr uint64_t kNotFirst[3] = {
        ~uint64_t(0), ~uint64_t(0xff), ~uint64_t(0x0101010101010101)};
    for (std::size_t x = 0; x < 8; ++x) {
        if (mask[x] == 0) continue;
        const T* row = x == 0 ? firstWord + kMargin : steps + 64 * x;
        const bool first = axis == Axis::X && x == 0;
        const uint64_t same = first ? 0 : EndAsBefore(row, row - stride) & kNotFirst[int(axis)];
        visit(x, row, same);
    }
}

template <typename T>
LeafMask AsBefore(const T* steps, Axis axis, const LeafMask& mask)
{
    LeafMask result{};
    ForEachWord(
        steps, axis, mask, [&](std::size_t x, const T*, uint64_t same) { result[x] = same; });
    return result;
}

/// The voxels of word x of a mask moved on by one along an axis.
HWY_INLINE uint64_t MovedOn(const LeafMask& mask, Axis axis, std::size_t x)
{
    if (axis == Axis::X) return x > 0 ? mask[x - 1] : 0;
    return mask[x] << (axis == Axis::Y ? 8 : 1);
}

template <typename T>
FreshSteps Fresh(const T* steps, Axis axis, const LeafMask& mask)
{
    FreshSteps fresh{};
    ForEachWord(steps, axis, mask, [&](std::size_t x, const T* row, uint64_t same) {
        const uint64_t own = mask[x] & ~(same & MovedOn(mask, axis, x));
        fresh.stay[x] = own & EqualTo(row, 0);
        fresh.go[x] = own & ~fresh.stay[x];
    });
    return fresh;
}

template <typename T>
void MarkEnds(const T* steps, const uint64_t* on, int rows, uint64_t* marks)
{
    for (int i = 0; i < rows; ++i) {
        const T* row = steps + at(i, 0);
        uint64_t left = on[i];
        if (left && i > 0) left &= ~(on[i - 1] & EndAsBefore(row, row - kLanes));
        while (left) { // few rounds: neighbours mostly have equal steps
            const int step = row[hwy::Num0BitsBelowLS1Bit_Nonzero64(left)];
            const uint64_t same = left & EqualTo(row, step);
            marks[i + step] |= same;
            left &= ~same;
        }
    }
}

void MarkEnds8(const int8_t* steps, const uint64_t* on, int rows, uint64_t* marks)
{
    MarkEnds(steps, on, rows, marks);
}
void MarkEnds16(const int16_t* steps, const uint64_t* on, int rows, uint64_t* marks)
{
    MarkEnds(steps, on, rows, marks);
}
LeafMask AsBefore8(const int8_t* steps, Axis axis, const LeafMask& mask)
{
    return AsBefore(steps, axis, mask);
}
LeafMask AsBefore16(const int16_t* steps, Axis axis, const LeafMask& mask)
{
    return AsBefore(steps, axis, mask);
}
FreshSteps Fresh8(const int8_t* steps, Axis axis, const LeafMask& mask)
{
    return Fresh(steps, axis, mask);
}
FreshSteps Fresh16(const int16_t* steps, Axis axis, const LeafMask& mask)
{
    return Fresh(steps, axis, mask);
}

} // namespace HWY_NAMESPACE
} // namespace detail
} // namespace openvdb_spheretree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree {
namespace detail {

HWY_EXPORT(AsBefore8);
HWY_EXPORT(AsBefore16);
HWY_EXPORT(Fresh8);
HWY_EXPORT(Fresh16);
HWY_EXPORT(MarkEnds8);
HWY_EXPORT(MarkEnds16);

LeafMask endsAsBefore(const int8_t* steps, Axis axis, const LeafMask& mask)
{
    return HWY_DYNAMIC_DISPATCH(AsBefore8)(steps, axis, mask);
}
LeafMask endsAsBefore(const int16_t* steps, Axis axis, const LeafMask& mask)
{
    return HWY_DYNAMIC_DISPATCH(AsBefore16)(steps, axis, mask);
}

FreshSteps freshSteps(const int8_t* steps, Axis axis, const LeafMask& mask)
{
    return HWY_DYNAMIC_DISPATCH(Fresh8)(steps, axis, mask);
}
FreshSteps freshSteps(const int16_t* steps, Axis axis, const LeafMask& mask)
{
    return HWY_DYNAMIC_DISPATCH(Fresh16)(steps, axis, mask);
}

void markRowEnds(const int8_t* steps, const uint64_t* on, int rows, uint64_t* marks)
{
    HWY_DYNAMIC_DISPATCH(MarkEnds8)(steps, on, rows, marks);
}
void markRowEnds(const int16_t* steps, const uint64_t* on, int rows, uint64_t* marks)
{
    HWY_DYNAMIC_DISPATCH(MarkEnds16)(steps, on, rows, marks);
}

} // namespace detail
} // namespace openvdb_spheretree
#endif
