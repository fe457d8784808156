// SPDX-License-Identifier: Apache-2.0
#include "MotionKernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/query/MotionKernels.cc"
#include <hwy/foreach_target.h>

#include "MotionLanes-inl.h"
#include <hwy/highway.h>

#include <openvdb_spheretree/base/Rounding.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Steps of a pair that is not two leaves, and of one that is, before doubles go on.
constexpr int kSteps = 2, kLeafSteps = 6;

/// @tparam Frame  MotionFrame or MutualFrame
template <class Frame>
class FirstContact {
public:
    FirstContact(const Frame& frame, const MotionLimits& limits)
        : mFrame(frame), mLimits(limits),
          mPad(toFloatUp(frame.pad + (1 + 1e-6) * limits.margin)) // a sum in floats has it, too
    {
        SetBest(limits.end);
    }

    MotionEnd Run()
    {
        mStack[0] = {{kRootPlace, kRootPlace}, 0.0f};
        mCount = 1;
        while (mCount > 0) {
            const Waiting next = mStack[--mCount];
            if (next.time >= mBest) continue;
            if (mEnd.blocks >= mLimits.maxBlocks) {
                mEnd.isDecided = false;
                ++mCount;
                break;
            }
            Descend(next);
        }
        mEnd.free = mEnd.time;
        for (int i = 0; i < mCount; ++i) mEnd.free = std::min(mEnd.free, double(mStack[i].time));
        return mEnd;
    }

private:
    struct Waiting {
        Pair pair;
        float time; ///< before which it cannot meet
    };

    void SetBest(double time)
    {
        mEnd.time = time;
        mBest = toFloatUp(time);
    }

    HWY_INLINE void Descend(const Waiting& next)
    {
        const Opened opened = Open(mFrame.pair, next.pair);
        const auto coming = ComingOf(mFrame, opened);
        const uint32_t leaves = opened.otherChild < 0 ? LeafLanes(*opened.block) : 0;
        // As many steps for all lanes of a block, whatever the width of vectors.
        const int most = leaves ? kLeafSteps : kSteps;
        int taken = 0;
        HWY_ALIGN float times[kBlockWidth];
        uint32_t soon = 0;
        for (int lane = 0; lane < kBlockWidth; lane += kWidth) {
            auto approach = ApproachOf(*opened.block, lane, coming, next.time, mPad);
            uint32_t live = 1;
            for (int step = 1; step <= most && live; ++step) {
                approach.Step(mBest);
                live = Bits(hn::Lt(approach.Time(), hn::Set(D(), mBest)));
                taken = std::max(taken, step);
            }
            soon |= live << lane;
            hn::Store(approach.Time(), D(), times + lane);
        }
        mEnd.blocks += taken;
        const int first = mCount;
        for (; soon; soon &= soon - 1) {
            const int lane = FirstLane(soon);
            if (isEmptyLane(*opened.block, lane) || times[lane] >= mBest) continue;
            if (leaves >> lane & 1) {
                AddLeaves(opened, lane, times[lane]);
                continue;
            }
            Push({opened.below(next.pair, lane), times[lane]}, first);
        }
    }

    /// The soonest of the pairs of a block comes to lie on top.
    HWY_INLINE void Push(const Waiting& waiting, int first)
    {
        int place = mCount++;
        for (; place > first && mStack[place - 1].time < waiting.time; --place) {
            mStack[place] = mStack[place - 1];
        }
        mStack[place] = waiting;
    }

    void AddLeaves(const Opened& opened, int lane, float from)
    {
        const FloatSphere here = opened.block->sphere(lane);
        const FloatSphere& ofA = opened.isOfA ? here : opened.own;
        const FloatSphere& ofB = opened.isOfA ? opened.own : here;
        double gap = 0;
        const double time = timeOfContact(mFrame, ofA, ofB, from, mEnd.time, mLimits, gap);
        const bool isFirst = mEnd.pair.a < 0 && time <= mEnd.time;
        if (time >= mEnd.time && !isFirst) return;
        mEnd.pair = {opened.leafA(lane), opened.leafB(lane), gap};
        SetBest(time);
    }

    const Frame& mFrame;
    const MotionLimits& mLimits;
    float mPad; ///< what radii grow by
    MotionEnd mEnd;
    float mBest = 0;
    int mCount = 0;
    Waiting mStack[kMostPairs];
};

MotionEnd FindFirstContact(const MotionFrame& frame, const MotionLimits& limits)
{
    return FirstContact<MotionFrame>(frame, limits).Run();
}

MotionEnd FindFirstMutualContact(const MutualFrame& frame, const MotionLimits& limits)
{
    return FirstContact<MutualFrame>(frame, limits).Run();
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::detail {

HWY_EXPORT(FindFirstContact);
HWY_EXPORT(FindFirstMutualContact);

MotionEnd findFirstContact(const MotionFrame& frame, const MotionLimits& limits)
{
    return HWY_DYNAMIC_DISPATCH(FindFirstContact)(frame, limits);
}

MotionEnd findFirstContact(const MutualFrame& frame, const MotionLimits& limits)
{
    return HWY_DYNAMIC_DISPATCH(FindFirstMutualContact)(frame, limits);
}

} // namespace openvdb_spheretree::detail
#endif
