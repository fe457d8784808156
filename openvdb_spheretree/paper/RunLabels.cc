// SPDX-License-Identifier: Apache-2.0
#include "RunLabels.h"

#include <openvdb_spheretree/kernel/OffsetBits.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/paper/RunLabels.cc"
#include <hwy/foreach_target.h>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail {
namespace HWY_NAMESPACE {

/// Made for each kind of processor because most have an instruction that counts bits, and the
/// oldest have none.
void RanksOf(const RunLabels& labels, uint32_t x, uint64_t bits, int32_t* ranks)
{
    for (; bits; bits &= bits - 1) {
        const auto lane = uint32_t(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
        ranks[lane] = labels.rankAt(x, lane);
    }
}

} // namespace HWY_NAMESPACE
} // namespace openvdb_spheretree::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::detail {

HWY_EXPORT(RanksOf);

namespace {

/// @param before  the offsets of the leaf before it in the run; null if it is the first
template <typename Offset>
LeafMask repeatsOf(const Offset* offsets, const Offset* before, const LeafMask& mask)
{
    LeafMask repeats = targetsAsBefore(offsets, Axis::X, mask);
    if (!before) return repeats;
    const Offset* last = before + 7 * 64;
    for (int lane = 0; lane < 64; ++lane) {
        repeats[0] |= uint64_t(offsets[lane] + 1 == last[lane]) << lane;
    }
    return repeats;
}

} // namespace

void RunLabels::findRanks(uint32_t x, uint64_t bits)
{
    HWY_DYNAMIC_DISPATCH(RanksOf)(*this, x, bits, mRanks.data() + kLaneMargin);
}

/// Offsets that will be followed soon: leaves that are neighbours along x are far apart in memory.
/// (The DAG of all levels of dragon-512, on one thread: 64 ms, without this 73.)
void RunLabels::prefetch(uint32_t i) const
{
    constexpr int kCacheLine = 64;
    if (i >= mRun.count) return;
    for (const Axis axis : {Axis::Y, Axis::Z}) {
        const int8_t* offsets = mLabels.narrowOffsets(axis, mRun.leaves[i]);
        if (!offsets) continue;
        for (int k = 0; k < kLeafVoxels; k += kCacheLine) hwy::Prefetch(offsets + k);
    }
}

void RunLabels::enterLeaf(uint32_t i)
{
    mPlace = i;
    if (i == 0) prefetch(1);
    prefetch(i + 2);
    const uint32_t here = leaf(), before = i == 0 ? 0 : mRun.leaves[i - 1];
    const LeafMask& mask = layout().mask(here);
    mOffsets = mLabels.narrowOffsets(Axis::X, here);
    if (mOffsets) {
        mRepeats =
            repeatsOf(mOffsets, i == 0 ? nullptr : mLabels.narrowOffsets(Axis::X, before), mask);
    } else if (const int16_t* wide = mLabels.wideOffsets(Axis::X, here)) {
        mRepeats = repeatsOf(wide, i == 0 ? nullptr : mLabels.wideOffsets(Axis::X, before), mask);
    } else {
        mRepeats = LeafMask{}; // labels are kept in another way: every voxel is looked up
    }
}

} // namespace openvdb_spheretree::detail
#endif
