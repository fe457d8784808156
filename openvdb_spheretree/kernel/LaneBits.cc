// SPDX-License-Identifier: Apache-2.0
#include "LaneBits.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/kernel/LaneBits.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

uint64_t EqualLanes(const int32_t* a, const int32_t* b)
{
    const hn::CappedTag<int32_t, 64> d;
    uint64_t bits = 0;
    for (std::size_t lane = 0; lane < 64; lane += hn::Lanes(d)) {
        uint64_t equal = 0; // of a few lanes one byte is written, of 16 two
        hn::StoreMaskBits(d, hn::Eq(hn::LoadU(d, a + lane), hn::LoadU(d, b + lane)),
            reinterpret_cast<uint8_t*>(&equal));
        bits |= equal << lane;
    }
    return bits;
}

LikeBefore LikeBeforeAlongBoth(const int32_t* row)
{
    constexpr uint64_t kFirstAlongY = 0xff, kFirstAlongZ = 0x0101010101010101;
    return {EqualLanes(row, row - 8) & ~kFirstAlongY, EqualLanes(row, row - 1) & ~kFirstAlongZ};
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::detail {

HWY_EXPORT(EqualLanes);
HWY_EXPORT(LikeBeforeAlongBoth);

uint64_t equalLanes(const int32_t* a, const int32_t* b)
{
    return HWY_DYNAMIC_DISPATCH(EqualLanes)(a, b);
}
LikeBefore likeBefore(const int32_t* row) { return HWY_DYNAMIC_DISPATCH(LikeBeforeAlongBoth)(row); }

} // namespace openvdb_spheretree::detail
#endif
