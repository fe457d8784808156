// SPDX-License-Identifier: Apache-2.0
#include "BackgroundGaps.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/kernel/BackgroundGaps.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::slab::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <typename Gap>
using Lanes64 = hn::CappedTag<Gap, 64>;

/// The gaps in one more plane of voxels, from those of the plane before it.
template <class D>
HWY_INLINE hn::Vec<D> gapsIn(D d, hn::Vec<D> before, uint64_t plane, std::size_t lane)
{
    const uint64_t bits = plane >> lane;
    const auto on = hn::LoadMaskBits(d, reinterpret_cast<const uint8_t*>(&bits));
    return hn::IfThenElseZero(on, hn::SaturatedAdd(before, hn::Set(d, hn::TFromD<D>(1))));
}

/// From the voxels beside the leaf through its planes x = first, first + by, ... to the last.
template <typename Gap>
HWY_INLINE void Through(const LeafMask& mask, const Gap* beside, Gap* last, int first, int by)
{
    const Lanes64<Gap> d;
    for (std::size_t lane = 0; lane < 64; lane += hn::Lanes(d)) {
        auto gaps = hn::LoadU(d, beside + lane);
        for (int k = 0, x = first; k < 8; ++k, x += by) gaps = gapsIn(d, gaps, mask[x], lane);
        hn::StoreU(gaps, d, last + lane);
    }
}

void Through8(const LeafMask& mask, const uint8_t* beside, uint8_t* last, bool back)
{
    if (back) Through(mask, beside, last, 7, -1);
    else Through(mask, beside, last, 0, 1);
}
void Through16(const LeafMask& mask, const uint16_t* beside, uint16_t* last, bool back)
{
    if (back) Through(mask, beside, last, 7, -1);
    else Through(mask, beside, last, 0, 1);
}

template <typename Gap, typename Square>
HWY_INLINE void Squares(const LeafMask& mask, const Gap* before, const Gap* behind, Square* rows)
{
    const Lanes64<Gap> d;
    HWY_ALIGN Gap nearest[512]; // in leaf order
    for (std::size_t lane = 0; lane < 64; lane += hn::Lanes(d)) {
        auto gaps = hn::LoadU(d, before + lane);
        for (int x = 0; x < 8; ++x) {
            gaps = gapsIn(d, gaps, mask[x], lane);
            hn::Store(gaps, d, nearest + 64 * x + lane);
        }
        gaps = hn::LoadU(d, behind + lane);
        for (int x = 7; x >= 0; --x) {
            gaps = gapsIn(d, gaps, mask[x], lane);
            Gap* other = nearest + 64 * x + lane;
            hn::Store(hn::Min(gaps, hn::Load(d, other)), d, other);
        }
    }
    const hn::CappedTag<Square, 8> wide;
    const hn::Rebind<Gap, decltype(wide)> narrow;
    for (std::size_t x = 0; x < 8; ++x) {
        for (std::size_t y = 0; y < 8; ++y) {
            for (std::size_t z = 0; z < 8; z += hn::Lanes(wide)) {
                auto gaps = hn::PromoteTo(wide, hn::LoadU(narrow, nearest + 64 * x + 8 * y + z));
                // 46340^2 < 2^31 (MinPlus.h); a byte needs no clamp, as 255^2 < 2^16.
                if (sizeof(Square) > 2) gaps = hn::Min(gaps, hn::Set(wide, Square(46340)));
                hn::StoreU(hn::Mul(gaps, gaps), wide, rows + 64 * y + 8 * x + z);
            }
        }
    }
}

void Squares8(const LeafMask& mask, const uint8_t* before, const uint8_t* behind, uint16_t* rows)
{
    Squares(mask, before, behind, rows);
}
void Squares16(const LeafMask& mask, const uint16_t* before, const uint16_t* behind, uint32_t* rows)
{
    Squares(mask, before, behind, rows);
}

} // namespace openvdb_spheretree::slab::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::slab {

HWY_EXPORT(Through8);
HWY_EXPORT(Through16);
HWY_EXPORT(Squares8);
HWY_EXPORT(Squares16);

void gapsThrough(const LeafMask& mask, const uint8_t* beside, uint8_t* last, bool back)
{
    HWY_DYNAMIC_DISPATCH(Through8)(mask, beside, last, back);
}
void gapsThrough(const LeafMask& mask, const uint16_t* beside, uint16_t* last, bool back)
{
    HWY_DYNAMIC_DISPATCH(Through16)(mask, beside, last, back);
}
void squaresOfGaps(
    const LeafMask& mask, const uint8_t* before, const uint8_t* behind, uint16_t* rows)
{
    HWY_DYNAMIC_DISPATCH(Squares8)(mask, before, behind, rows);
}
void squaresOfGaps(
    const LeafMask& mask, const uint16_t* before, const uint16_t* behind, uint32_t* rows)
{
    HWY_DYNAMIC_DISPATCH(Squares16)(mask, before, behind, rows);
}

} // namespace openvdb_spheretree::slab
#endif
