// SPDX-License-Identifier: Apache-2.0
#include "PairKernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/query/PairKernels.cc"
#include <hwy/foreach_target.h>

#include "PairLanes-inl.h"
#include <hwy/highway.h>

#include <openvdb_spheretree/base/Rounding.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// What sums of radii grow by, so that no pair is missed whose gap is the margin or less.
float ReachOf(const PairFrame& frame, const SearchLimits& limits)
{
    return toFloatUp(limits.margin + 1e-6 * std::abs(limits.margin) + frame.pad);
}

/// Any pair that meets: lanes that meet are descended into, the deepest first.
class OverlapSearch {
public:
    OverlapSearch(const PairFrame& frame, const SearchLimits& limits)
        : mFrame(frame), mLimits(limits), mReach(ReachOf(frame, limits))
    {}

    template <bool kWantsBound>
    SearchEnd Run()
    {
        mStack[0] = {kRootPlace, kRootPlace};
        mCount = 1;
        while (mCount > 0) {
            if (mEnd.blocks == mLimits.maxBlocks) {
                mEnd.isDecided = false;
                return mEnd;
            }
            const Pair pair = mStack[--mCount];
            Opened opened = Open(mFrame, pair);
            opened.other.r += mReach;
            ++mEnd.blocks;
            if (Descend<kWantsBound>(pair, opened)) return mEnd;
        }
        if (kWantsBound)
            mEnd.lowerBound = std::min(double(mLeast) + mLimits.margin, mLeastOfLeaves);
        return mEnd;
    }

private:
    /// @return whether leaves that meet are found.
    template <bool kWantsBound>
    HWY_INLINE bool Descend(const Pair& pair, const Opened& opened)
    {
        HWY_ALIGN float depth[kBlockWidth];
        uint32_t hits = Test<kWantsBound>(opened, depth);
        uint32_t leaves = opened.otherChild < 0 ? hits & LeafLanes(*opened.block) : 0;
        hits ^= leaves;
        for (; leaves; leaves &= leaves - 1) {
            if (Meet(opened, FirstLane(leaves))) return true;
        }
        if (!hits) return false;
        int count = mCount, deepest = count;
        float most = 1;
        for (; hits; hits &= hits - 1) {
            const int lane = FirstLane(hits);
            deepest = depth[lane] < most ? count : deepest;
            most = std::min(most, depth[lane]);
            mStack[count++] = opened.below(pair, lane);
        }
        mCount = count;
        std::swap(mStack[deepest], mStack[count - 1]);
        return IsDeep(opened, most) && LargestMeet(pair, opened);
    }

    /// Whether the largest leaves of both are worth a look: at the top, and if a lane's center is far inside.
    static HWY_INLINE bool IsDeep(const Opened& opened, float depth)
    {
        const float r = opened.other.r;
        return opened.place == 0 && depth < -2 * r * r;
    }

    /// Tests the largest leaf below each lane of a root's block against that below the other sphere.
    bool LargestMeet(const Pair& pair, const Opened& opened)
    {
        const int32_t other = opened.isOfA ? pair.b : pair.a;
        if (other >= kBlockWidth || mEnd.blocks == mLimits.maxBlocks) return false;
        const SphereBlocks& here = opened.isOfA ? *mFrame.a : *mFrame.b;
        const SphereBlocks& there = opened.isOfA ? *mFrame.b : *mFrame.a;
        Opened largest = opened;
        largest.block = &here.largestLeaves;
        largest.otherChild =
            other == kRootPlace ? ~there.largestLeaf : there.largestLeaves.child[other];
        largest.own =
            other == kRootPlace ? there.leaf(there.largestLeaf) : there.largestLeaves.sphere(other);
        largest.other = Moved(opened.isOfA ? mFrame.toA : mFrame.toB, largest.own);
        largest.other.r += mReach;
        ++mEnd.blocks;
        HWY_ALIGN float depth[kBlockWidth];
        for (uint32_t hits = Test<false>(largest, depth); hits; hits &= hits - 1) {
            if (Meet(largest, FirstLane(hits))) return true;
        }
        return false;
    }

    /// @return lanes that meet the sphere; `depth` receives the square of their distance less that of the
    ///         radii.
    template <bool kWantsBound>
    HWY_INLINE uint32_t Test(const Opened& opened, float* depth)
    {
        const D d;
        uint32_t hits = 0;
        for (int lane = 0; lane < kBlockWidth; lane += kWidth) {
            const V distSq = DistSq(*opened.block, lane, opened.other);
            const V sum = hn::Add(hn::Load(d, opened.block->r + lane), hn::Set(d, opened.other.r));
            const V reach = hn::Max(sum, hn::Zero(d)); // of a negative margin
            const V reachSq = hn::Mul(reach, reach);
            const auto meets = hn::Le(distSq, reachSq);
            hits |= Bits(meets) << lane;
            hn::Store(hn::Sub(distSq, reachSq), d, depth + lane);
            if (kWantsBound)
                AddBound(
                    hn::IfThenElse(meets, hn::Set(d, kEmptyLane), hn::Sub(hn::Sqrt(distSq), sum)));
        }
        return hits;
    }

    HWY_INLINE void AddBound(const V& gaps)
    {
        mLeast = std::min(mLeast, hn::GetLane(hn::MinOfLanes(D(), gaps)));
    }

    bool Meet(const Opened& opened, int lane)
    {
        const LeafPair pair{opened.leafA(lane), opened.leafB(lane), GapOf(mFrame, opened, lane)};
        mLeastOfLeaves = std::min(mLeastOfLeaves, pair.gap);
        if (pair.gap > mLimits.margin + mFrame.rounding) return false;
        mEnd.pair = pair;
        return true;
    }

    const PairFrame& mFrame;
    const SearchLimits& mLimits;
    float mReach; ///< what radii grow by
    float mLeast = kEmptyLane;
    double mLeastOfLeaves = std::numeric_limits<double>::infinity();
    SearchEnd mEnd;
    int mCount = 0;
    Pair mStack[kMostPairs];
};

/// All pairs that meet.
class AllOverlaps {
public:
    AllOverlaps(const PairFrame& frame, const SearchLimits& limits, const PairSink& sink)
        : mFrame(frame), mLimits(limits), mSink(sink), mReach(ReachOf(frame, limits)),
          mSlack(2.001f * frame.pad + 4e-6f * float(std::abs(limits.margin)))
    {}

    SearchEnd Run()
    {
        mStack[0] = {kRootPlace, kRootPlace};
        mCount = 1;
        while (mCount > 0) {
            const Pair pair = mStack[--mCount];
            Opened opened = Open(mFrame, pair);
            opened.other.r += mReach;
            ++mEnd.blocks;
            Descend(pair, opened);
            if (mFound > kMostFound - kMostOfStep && !Flush()) return mEnd;
        }
        Flush();
        return mEnd;
    }

private:
    /// What a step may find: each leaf of a block may meet eight of another, and they one.
    static constexpr int kMostOfStep = kBlockWidth * (kBlockWidth + 1);
    static constexpr int kMostFound = 4 * kMostOfStep;

    HWY_INLINE void Descend(const Pair& pair, const Opened& opened)
    {
        uint32_t hits = Collect(opened);
        uint32_t leaves = opened.otherChild >= 0 ? hits & LeafLanes(*opened.block) : 0;
        hits ^= leaves;
        Push(pair, opened, hits); // below those of leaves, or these would pile up
        // A leaf that meets a node: its block comes next, without the way over the stack.
        for (; leaves; leaves &= leaves - 1) {
            const int lane = FirstLane(leaves);
            const Opened next = Against(opened, lane);
            ++mEnd.blocks;
            Push(opened.below(pair, lane), next, Collect(next));
        }
    }

    HWY_INLINE void Push(const Pair& pair, const Opened& opened, uint32_t lanes)
    {
        int count = mCount;
        for (; lanes; lanes &= lanes - 1) mStack[count++] = opened.below(pair, FirstLane(lanes));
        mCount = count;
    }

    /// @return the block below the other sphere, and a lane's sphere in its frame.
    HWY_INLINE Opened Against(const Opened& opened, int lane) const
    {
        Opened next;
        next.isOfA = !opened.isOfA;
        next.block = (next.isOfA ? mFrame.a : mFrame.b)->blocks.data() + opened.otherChild;
        next.place = kBlockWidth * opened.otherChild;
        next.own = opened.block->sphere(lane);
        next.other = Moved(next.isOfA ? mFrame.toA : mFrame.toB, next.own);
        next.other.r += mReach;
        next.otherChild = opened.block->child[lane];
        return next;
    }

    /// Notes leaves that meet. @return lanes that meet, and are none.
    HWY_INLINE uint32_t Collect(const Opened& opened)
    {
        uint32_t hits = 0, certain = 0;
        Test(opened, hits, certain);
        uint32_t leaves = opened.otherChild < 0 ? hits & LeafLanes(*opened.block) : 0;
        hits ^= leaves;
        for (uint32_t unsure = leaves & ~certain; unsure; unsure &= unsure - 1) {
            const int lane = FirstLane(unsure);
            if (GapOf(mFrame, opened, lane) > mLimits.margin + mFrame.rounding)
                leaves &= ~(1u << lane);
        }
        int found = mFound;
        for (; leaves; leaves &= leaves - 1) {
            const int lane = FirstLane(leaves);
            mPairs[found++] = {
                mSink.firstA + opened.leafA(lane), mSink.firstB + opened.leafB(lane)};
        }
        mFound = found;
        return hits;
    }

    /// @return false if no more is wanted.
    bool Flush()
    {
        if (mFound == 0) return true;
        mEnd.pair = {mPairs[0].a - mSink.firstA, mPairs[0].b - mSink.firstB, 0};
        const bool more = mSink.add(mSink.context, mPairs, mFound);
        mFound = 0;
        return more;
    }

    /// Lanes that may meet the sphere, and of these the ones that do for certain: by more than rounding.
    HWY_INLINE void Test(const Opened& opened, uint32_t& hits, uint32_t& certain) const
    {
        const D d;
        for (int lane = 0; lane < kBlockWidth; lane += kWidth) {
            const V distSq = DistSq(*opened.block, lane, opened.other);
            const V sum = hn::Add(hn::Load(d, opened.block->r + lane), hn::Set(d, opened.other.r));
            const V reach = hn::Max(sum, hn::Zero(d));
            const V least = hn::Max(hn::Sub(sum, hn::Set(d, mSlack)), hn::Zero(d));
            hits |= Bits(hn::Le(distSq, hn::Mul(reach, reach))) << lane;
            certain |= Bits(hn::Lt(distSq, hn::Mul(least, least))) << lane;
        }
    }

    const PairFrame& mFrame;
    const SearchLimits& mLimits;
    const PairSink& mSink;
    float mReach, mSlack;
    SearchEnd mEnd;
    int mCount = 0, mFound = 0;
    NodePair mPairs[kMostFound];
    /// Leaves of one block wait with up to eight nodes each, and are gone before the next block has any.
    Pair mStack[kMostPairs + kBlockWidth * kBlockWidth];
};

/// The pairs with the smallest gaps: branch and bound, depth first, the nearest first.
class NearestSearch {
public:
    NearestSearch(const PairFrame& frame, const NearestLimits& limits, LeafPair* pairs, int count)
        : mFrame(frame), mLimits(limits), mPairs(pairs), mFound(count)
    {
        std::make_heap(mPairs, mPairs + mFound, IsNearer);
        SetBound();
    }

    SearchEnd Run(int& count)
    {
        const float root = toFloatDown(mFrame.rootGap());
        mStack[0] = {{kRootPlace, kRootPlace}, root};
        mCount = 1;
        while (mCount > 0 && !mIsDone) {
            const Waiting next = mStack[--mCount];
            if (next.bound >= mBound) continue;
            if (mEnd.blocks == mLimits.maxBlocks) {
                mEnd.isDecided = false;
                ++mCount;
                break;
            }
            ++mEnd.blocks;
            Descend(next.pair, Open(mFrame, next.pair));
        }
        SetLowerBound();
        std::sort_heap(mPairs, mPairs + mFound, IsNearer);
        count = mFound;
        if (mFound > 0) mEnd.pair = mPairs[0];
        return mEnd;
    }

private:
    struct Waiting {
        Pair pair;
        float bound;
    };

    /// Ties by leaf, so that the order of a search does not show.
    static bool IsNearer(const LeafPair& p, const LeafPair& q)
    {
        if (p.gap != q.gap) return p.gap < q.gap;
        return p.a != q.a ? p.a < q.a : p.b < q.b;
    }

    /// What no pair above is looked at any more.
    double Target() const
    {
        if (mFound < mLimits.wanted) return mLimits.below;
        const double gap = mPairs[0].gap;
        const double lower = gap - std::max(mLimits.absErr, gap > 0 ? gap * mLimits.relErr : 0.0);
        return std::min(mLimits.below, lower);
    }

    /// As floats see it: with what they may be off by.
    void SetBound() { mBound = toFloatUp(Target() + mFrame.pad); }

    /// The least gap that a pair may have that was not found: what was left out by the last bound, or still
    /// waits.
    void SetLowerBound()
    {
        double lower = Target();
        for (int i = 0; i < mCount; ++i)
            lower = std::min(lower, double(mStack[i].bound) - mFrame.pad);
        if (mFound > 0) {
            const double nearest = std::min_element(mPairs, mPairs + mFound, IsNearer)->gap;
            lower = std::min(lower, nearest);
        }
        mEnd.lowerBound = lower;
    }

    HWY_INLINE void Descend(const Pair& pair, const Opened& opened)
    {
        HWY_ALIGN float gaps[kBlockWidth];
        uint32_t hits = Test(opened, gaps);
        uint32_t leaves = opened.otherChild < 0 ? hits & LeafLanes(*opened.block) : 0;
        hits ^= leaves;
        for (; leaves; leaves &= leaves - 1) {
            const int lane = FirstLane(leaves);
            if (gaps[lane] >= mBound) continue; // a pair of this block has lowered it
            Add({opened.leafA(lane), opened.leafB(lane), GapOf(mFrame, opened, lane)});
        }
        if (!hits) return;
        int count = mCount, nearest = count;
        float least = std::numeric_limits<float>::infinity();
        for (; hits; hits &= hits - 1) {
            const int lane = FirstLane(hits);
            const float bound = gaps[lane];
            nearest = bound < least ? count : nearest;
            least = std::min(least, bound);
            mStack[count++] = {opened.below(pair, lane), bound};
        }
        mCount = count;
        std::swap(mStack[nearest], mStack[count - 1]);
    }

    HWY_INLINE uint32_t Test(const Opened& opened, float* gaps) const
    {
        const D d;
        uint32_t hits = 0;
        for (int lane = 0; lane < kBlockWidth; lane += kWidth) {
            const V distSq = DistSq(*opened.block, lane, opened.other);
            const V sum = hn::Add(hn::Load(d, opened.block->r + lane), hn::Set(d, opened.other.r));
            const V gap = hn::Sub(hn::Sqrt(distSq), sum);
            hits |= Bits(hn::Lt(gap, hn::Set(d, mBound))) << lane;
            hn::Store(gap, d, gaps + lane);
        }
        return hits;
    }

    void Add(const LeafPair& pair)
    {
        if (!(pair.gap < mLimits.below)) return;
        if (mFound == mLimits.wanted) {
            if (!IsNearer(pair, mPairs[0])) return;
            std::pop_heap(mPairs, mPairs + mFound--, IsNearer);
        }
        mPairs[mFound++] = pair;
        std::push_heap(mPairs, mPairs + mFound, IsNearer);
        mIsDone = pair.gap <= mLimits.stopBelow;
        SetBound();
    }

    const PairFrame& mFrame;
    const NearestLimits& mLimits;
    LeafPair* mPairs; ///< a heap, the farthest first
    int mFound;
    float mBound = 0;
    bool mIsDone = false;
    SearchEnd mEnd;
    int mCount = 0;
    Waiting mStack[kMostPairs];
};

SearchEnd FindOverlap(const PairFrame& frame, const SearchLimits& limits, bool wantBound)
{
    OverlapSearch search(frame, limits);
    return wantBound ? search.Run<true>() : search.Run<false>();
}

SearchEnd FindAllOverlaps(const PairFrame& frame, const SearchLimits& limits, const PairSink& sink)
{
    return AllOverlaps(frame, limits, sink).Run();
}

SearchEnd FindNearest(
    const PairFrame& frame, const NearestLimits& limits, LeafPair* pairs, int& count)
{
    return NearestSearch(frame, limits, pairs, count).Run(count);
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::detail {

HWY_EXPORT(FindOverlap);
HWY_EXPORT(FindAllOverlaps);
HWY_EXPORT(FindNearest);

SearchEnd findOverlap(const PairFrame& frame, const SearchLimits& limits, bool wantBound)
{
    return HWY_DYNAMIC_DISPATCH(FindOverlap)(frame, limits, wantBound);
}

SearchEnd findAllOverlaps(const PairFrame& frame, const SearchLimits& limits, const PairSink& sink)
{
    return HWY_DYNAMIC_DISPATCH(FindAllOverlaps)(frame, limits, sink);
}

SearchEnd findNearest(
    const PairFrame& frame, const NearestLimits& limits, LeafPair* pairs, int& count)
{
    return HWY_DYNAMIC_DISPATCH(FindNearest)(frame, limits, pairs, count);
}

} // namespace openvdb_spheretree::detail
#endif
