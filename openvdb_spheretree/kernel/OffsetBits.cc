// SPDX-License-Identifier: Apache-2.0
#include "OffsetBits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/kernel/OffsetBits.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// @return the lanes for which test(lane), of the vector that begins there, is true.
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
HWY_INLINE uint64_t EqualTo(const T* row, int offset)
{
    const hn::CappedTag<T, 64> d;
    const auto value = hn::Set(d, T(offset));
    return LanesThat(d, [&](std::size_t lane) { return hn::Eq(hn::LoadU(d, row + lane), value); });
}

/// @param before  64 values: those before the row's along the axis
template <typename T>
HWY_INLINE uint64_t TargetAsBefore(const T* row, const T* before)
{
    const hn::CappedTag<T, 64> d;
    return LanesThat(d, [&](std::size_t lane) {
        const auto offset = hn::LoadU(d, row + lane);
        return hn::Eq(hn::Add(offset, hn::Set(d, T(1))), hn::LoadU(d, before + lane));
    });
}

/// Calls visit(x, row, same) for words of @a mask that are not empty: their 64 offsets, and which
/// voxels have the target of the voxel before them along the axis.
template <typename T, typename Visit>
HWY_INLINE void ForEachWord(const T* offsets, Axis axis, const LeafMask& mask, const Visit& visit)
{
    // The first voxels along the axis have none before them: what is read there is in `firstWord`.
    constexpr std::size_t kMargin = 64;
    T firstWord[kMargin + 64];
    std::fill_n(firstWord, kMargin, T(0));
    std::memcpy(firstWord + kMargin, offsets, 64 * sizeof(T));
    const std::size_t stride = std::size_t(64) >> (3 * int(axis));
    constexpr uint64_t kNotFirst[3] = {
        ~uint64_t(0), ~uint64_t(0xff), ~uint64_t(0x0101010101010101)};
    for (std::size_t x = 0; x < 8; ++x) {
        if (mask[x] == 0) continue;
        const T* row = x == 0 ? firstWord + kMargin : offsets + 64 * x;
        const bool first = axis == Axis::X && x == 0;
        const uint64_t same = first ? 0 : TargetAsBefore(row, row - stride) & kNotFirst[int(axis)];
        visit(x, row, same);
    }
}

template <typename T>
LeafMask TargetsAsBefore(const T* offsets, Axis axis, const LeafMask& mask)
{
    LeafMask result{};
    ForEachWord(
        offsets, axis, mask, [&](std::size_t x, const T*, uint64_t same) { result[x] = same; });
    return result;
}

/// The voxels of word x of a mask moved on by one along an axis.
HWY_INLINE uint64_t MovedOn(const LeafMask& mask, Axis axis, std::size_t x)
{
    if (axis == Axis::X) return x > 0 ? mask[x - 1] : 0;
    return mask[x] << (axis == Axis::Y ? 8 : 1);
}

template <typename T>
FreshOffsets Fresh(const T* offsets, Axis axis, const LeafMask& mask)
{
    FreshOffsets fresh{};
    ForEachWord(offsets, axis, mask, [&](std::size_t x, const T* row, uint64_t same) {
        const uint64_t own = mask[x] & ~(same & MovedOn(mask, axis, x));
        fresh.stay[x] = own & EqualTo(row, 0);
        fresh.go[x] = own & ~fresh.stay[x];
    });
    return fresh;
}

template <typename T>
void MarkTargets(const T* offsets, const uint64_t* on, int rows, uint64_t* marks)
{
    for (int i = 0; i < rows; ++i) {
        const T* row = offsets + at(i, 0);
        uint64_t left = on[i];
        if (left && i > 0) left &= ~(on[i - 1] & TargetAsBefore(row, row - kLanes));
        while (left) { // few rounds: neighbours mostly have equal offsets
            const int offset = row[hwy::Num0BitsBelowLS1Bit_Nonzero64(left)];
            const uint64_t same = left & EqualTo(row, offset);
            marks[i + offset] |= same;
            left &= ~same;
        }
    }
}

void MarkTargets8(const int8_t* offsets, const uint64_t* on, int rows, uint64_t* marks)
{
    MarkTargets(offsets, on, rows, marks);
}
void MarkTargets16(const int16_t* offsets, const uint64_t* on, int rows, uint64_t* marks)
{
    MarkTargets(offsets, on, rows, marks);
}
LeafMask TargetsAsBefore8(const int8_t* offsets, Axis axis, const LeafMask& mask)
{
    return TargetsAsBefore(offsets, axis, mask);
}
LeafMask TargetsAsBefore16(const int16_t* offsets, Axis axis, const LeafMask& mask)
{
    return TargetsAsBefore(offsets, axis, mask);
}
FreshOffsets Fresh8(const int8_t* offsets, Axis axis, const LeafMask& mask)
{
    return Fresh(offsets, axis, mask);
}
FreshOffsets Fresh16(const int16_t* offsets, Axis axis, const LeafMask& mask)
{
    return Fresh(offsets, axis, mask);
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::detail {

HWY_EXPORT(TargetsAsBefore8);
HWY_EXPORT(TargetsAsBefore16);
HWY_EXPORT(Fresh8);
HWY_EXPORT(Fresh16);
HWY_EXPORT(MarkTargets8);
HWY_EXPORT(MarkTargets16);

LeafMask targetsAsBefore(const int8_t* offsets, Axis axis, const LeafMask& mask)
{
    return HWY_DYNAMIC_DISPATCH(TargetsAsBefore8)(offsets, axis, mask);
}
LeafMask targetsAsBefore(const int16_t* offsets, Axis axis, const LeafMask& mask)
{
    return HWY_DYNAMIC_DISPATCH(TargetsAsBefore16)(offsets, axis, mask);
}

FreshOffsets freshOffsets(const int8_t* offsets, Axis axis, const LeafMask& mask)
{
    return HWY_DYNAMIC_DISPATCH(Fresh8)(offsets, axis, mask);
}
FreshOffsets freshOffsets(const int16_t* offsets, Axis axis, const LeafMask& mask)
{
    return HWY_DYNAMIC_DISPATCH(Fresh16)(offsets, axis, mask);
}

void markRowTargets(const int8_t* offsets, const uint64_t* on, int rows, uint64_t* marks)
{
    HWY_DYNAMIC_DISPATCH(MarkTargets8)(offsets, on, rows, marks);
}
void markRowTargets(const int16_t* offsets, const uint64_t* on, int rows, uint64_t* marks)
{
    HWY_DYNAMIC_DISPATCH(MarkTargets16)(offsets, on, rows, marks);
}

} // namespace openvdb_spheretree::detail
#endif
