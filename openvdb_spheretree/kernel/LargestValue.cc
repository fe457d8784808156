// SPDX-License-Identifier: Apache-2.0
#include "LargestValue.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/kernel/LargestValue.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <typename T>
HWY_INLINE uint32_t Largest(const T* values, std::size_t count)
{
    const hn::CappedTag<T, 64> d;
    auto largest = hn::Zero(d);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        largest = hn::Max(largest, hn::LoadU(d, values + i));
    }
    return uint32_t(hn::GetLane(hn::MaxOfLanes(d, largest)));
}

uint32_t Largest16(const uint16_t* values, std::size_t count) { return Largest(values, count); }
uint32_t Largest32(const uint32_t* values, std::size_t count) { return Largest(values, count); }

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::detail {

HWY_EXPORT(Largest16);
HWY_EXPORT(Largest32);

uint32_t largestValue(const uint16_t* values, std::size_t count)
{
    return HWY_DYNAMIC_DISPATCH(Largest16)(values, count);
}
uint32_t largestValue(const uint32_t* values, std::size_t count)
{
    return HWY_DYNAMIC_DISPATCH(Largest32)(values, count);
}

} // namespace openvdb_spheretree::detail
#endif
