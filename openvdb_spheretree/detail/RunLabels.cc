// SPDX-License-Identifier: Apache-2.0
#include "RunLabels.h"

#include "StepBits.h"

namespace openvdb_spheretree {
namespace detail {

namespace {

/// @param before  the steps of the leaf before it in the run; null if it is the first
template <typename Step>
LeafMask repeatsOf(const Step* steps, const Step* before)
{
    LeafMask repeats = stepBits(steps, Axis::X).asBefore;
    if (!before) return repeats;
    const Step* last = before + 7 * 64;
    for (int lane = 0; lane < 64; ++lane) {
        repeats[0] |= uint64_t(steps[lane] + 1 == last[lane]) << lane;
    }
    return repeats;
}

} // namespace

void RunLabels::enterLeaf(uint32_t i)
{
    mPlace = i;
    const uint32_t here = leaf(), before = i == 0 ? 0 : mRun.leaves[i - 1];
    mSteps = mLabels.narrowSteps(Axis::X, here);
    if (mSteps) {
        mRepeats = repeatsOf(mSteps, i == 0 ? nullptr : mLabels.narrowSteps(Axis::X, before));
    } else if (const int16_t* wide = mLabels.wideSteps(Axis::X, here)) {
        mRepeats = repeatsOf(wide, i == 0 ? nullptr : mLabels.wideSteps(Axis::X, before));
    } else {
        mRepeats = LeafMask{}; // labels are kept in another way: every voxel is looked up
    }
}

} // namespace detail
} // namespace openvdb_spheretree
