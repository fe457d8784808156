// SPDX-License-Identifier: Apache-2.0
#include "StepBits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/detail/StepBits.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree {
namespace detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Sets word x of all masks.
/// @param before of the first lane in use: the 64 values that stand before the row's along the axis
template <typename T>
HWY_INLINE void RowBits(const T* row, const T* before, std::size_t x, StepBits& bits)
{
    const hn::CappedTag<T, 64> d;
    const auto one = hn::Set(d, T(1)), back = hn::Set(d, T(-1));
    const auto wordOf = [&](auto lanes) {
        uint64_t word = 0;
        hn::StoreMaskBits(d, lanes, reinterpret_cast<uint8_t*>(&word));
        return word;
    };
    uint64_t stays = 0, asBefore = 0, forward = 0, backward = 0;
    for (std::size_t lane = 0; lane < 64; lane += hn::Lanes(d)) {
        const auto step = hn::LoadU(d, row + lane);
        const auto previous = hn::LoadU(d, before + lane);
        stays |= wordOf(hn::Eq(step, hn::Zero(d))) << lane;
        asBefore |= wordOf(hn::Eq(hn::Add(step, one), previous)) << lane;
        forward |= wordOf(hn::Eq(step, one)) << lane;
        backward |= wordOf(hn::Eq(step, back)) << lane;
    }
    bits.stays[x] = stays;
    bits.asBefore[x] = asBefore;
    bits.forward[x] = forward;
    bits.back[x] = backward;
}

template <typename T>
StepBits Bits(const T* steps, Axis axis, const LeafMask& mask)
{
    // Voxels at the leaf's own border have none before them; reading there stays in `firstWord`.
    constexpr std::size_t kMargin = 64;
    T firstWord[kMargin + 64];
    std::fill_n(firstWord, kMargin, T(0));
    std::memcpy(firstWord + kMargin, steps, 64 * sizeof(T));
    const std::size_t stride = std::size_t(64) >> (3 * int(axis));
    constexpr uint64_t kNotFirst[3] = {
        ~uint64_t(0), ~uint64_t(0xff), ~uint64_t(0x0101010101010101)};
    StepBits bits;
    for (std::size_t x = 0; x < 8; ++x) {
        if (mask[x] == 0) continue;
        const T* row = x == 0 ? firstWord + kMargin : steps + 64 * x;
        RowBits(row, row - stride, x, bits);
        bits.asBefore[x] &= kNotFirst[int(axis)];
    }
    if (axis == Axis::X) bits.asBefore[0] = 0;
    return bits;
}

StepBits Bits8(const int8_t* steps, Axis axis, const LeafMask& mask)
{
    return Bits(steps, axis, mask);
}
StepBits Bits16(const int16_t* steps, Axis axis, const LeafMask& mask)
{
    return Bits(steps, axis, mask);
}

} // namespace HWY_NAMESPACE
} // namespace detail
} // namespace openvdb_spheretree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree {
namespace detail {

HWY_EXPORT(Bits8);
HWY_EXPORT(Bits16);

StepBits stepBits(const int8_t* steps, Axis axis, const LeafMask& mask)
{
    return HWY_DYNAMIC_DISPATCH(Bits8)(steps, axis, mask);
}
StepBits stepBits(const int16_t* steps, Axis axis, const LeafMask& mask)
{
    return HWY_DYNAMIC_DISPATCH(Bits16)(steps, axis, mask);
}

} // namespace detail
} // namespace openvdb_spheretree
#endif
