// SPDX-License-Identifier: Apache-2.0
#include "StepBits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/detail/StepBits.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree {
namespace detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// @param before of the first lane in use: the 64 values that stand before the row's along the axis
template <typename T>
void RowBits(const T* row, const T* before, uint64_t& stays, uint64_t& asBefore)
{
    const hn::CappedTag<T, 64> d;
    const auto one = hn::Set(d, T(1));
    stays = asBefore = 0;
    for (std::size_t lane = 0; lane < 64; lane += hn::Lanes(d)) {
        const auto step = hn::LoadU(d, row + lane);
        const auto previous = hn::LoadU(d, before + lane);
        uint64_t zero = 0, same = 0;
        hn::StoreMaskBits(d, hn::Eq(step, hn::Zero(d)), reinterpret_cast<uint8_t*>(&zero));
        hn::StoreMaskBits(
            d, hn::Eq(hn::Add(step, one), previous), reinterpret_cast<uint8_t*>(&same));
        stays |= zero << lane;
        asBefore |= same << lane;
    }
}

template <typename T>
StepBits Bits(const T* steps, Axis axis)
{
    // Voxels at the leaf's own border have none before them; reading there stays within `padded`.
    constexpr std::size_t kMargin = 64;
    T padded[kMargin + kLeafVoxels];
    std::memset(padded, 0, kMargin * sizeof(T));
    std::memcpy(padded + kMargin, steps, kLeafVoxels * sizeof(T));
    const std::size_t stride = std::size_t(64) >> (3 * int(axis));
    constexpr uint64_t kNotFirst[3] = {
        ~uint64_t(0), ~uint64_t(0xff), ~uint64_t(0x0101010101010101)};
    StepBits bits;
    for (std::size_t x = 0; x < 8; ++x) {
        const T* row = padded + kMargin + 64 * x;
        RowBits(row, row - stride, bits.stays[x], bits.asBefore[x]);
        bits.asBefore[x] &= kNotFirst[int(axis)];
    }
    if (axis == Axis::X) bits.asBefore[0] = 0;
    return bits;
}

StepBits Bits8(const int8_t* steps, Axis axis) { return Bits(steps, axis); }
StepBits Bits16(const int16_t* steps, Axis axis) { return Bits(steps, axis); }

} // namespace HWY_NAMESPACE
} // namespace detail
} // namespace openvdb_spheretree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree {
namespace detail {

HWY_EXPORT(Bits8);
HWY_EXPORT(Bits16);

StepBits stepBits(const int8_t* steps, Axis axis)
{
    return HWY_DYNAMIC_DISPATCH(Bits8)(steps, axis);
}
StepBits stepBits(const int16_t* steps, Axis axis)
{
    return HWY_DYNAMIC_DISPATCH(Bits16)(steps, axis);
}

} // namespace detail
} // namespace openvdb_spheretree
#endif
