// SPDX-License-Identifier: Apache-2.0
/// @file BlockLanes-inl.h
/// @brief The lanes of a block as vectors, which all kernels of questions share. Compiled once for
/// each instruction set.

#if defined(SPHERETREE_BLOCK_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHERETREE_BLOCK_LANES_INL_H
#undef SPHERETREE_BLOCK_LANES_INL_H
#else
#define SPHERETREE_BLOCK_LANES_INL_H
#endif

#include "SphereBlocks.h"

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kBlockWidth>;
using V = hn::Vec<D>;
constexpr int kWidth = int(hn::MaxLanes(D()));

/// One bit a lane.
template <typename Mask>
HWY_INLINE uint32_t Bits(const Mask& mask)
{
    uint64_t bits = 0; // of a few lanes one byte is written, of 16 two
    hn::StoreMaskBits(D(), mask, reinterpret_cast<uint8_t*>(&bits));
    return uint32_t(bits);
}

HWY_INLINE int FirstLane(uint32_t bits) { return int(hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)); }

/// Lanes whose spheres are leaves, and empty ones.
HWY_INLINE uint32_t LeafLanes(const SphereBlock& block)
{
    const hn::RebindToSigned<D> d;
    uint64_t bits = 0;
    uint32_t lanes = 0;
    for (int lane = 0; lane < kBlockWidth; lane += kWidth) {
        hn::StoreMaskBits(d, hn::Lt(hn::Load(d, block.child + lane), hn::Zero(d)),
            reinterpret_cast<uint8_t*>(&bits));
        lanes |= uint32_t(bits) << lane;
    }
    return lanes;
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif // SPHERETREE_BLOCK_LANES_INL_H
