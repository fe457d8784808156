// SPDX-License-Identifier: Apache-2.0
/// @file EnvelopeSearch-inl.h
/// @brief One axis of a separable transform: for every row i the best row j, by value(j) and the
/// penalty (i - j)^2, for 64 lines side by side. Exact.
///
/// Both transforms are this search: the distance transform takes the smallest value + (i - j)^2,
/// the power map the largest value - (i - j)^2 (CM07, sections 2 and 3). To build the envelope of
/// parabolas line by line is scalar work. But the penalty is convex: as i grows, the best j never
/// moves backwards. This serves all lanes of a vector at once:
///
/// 1. `leafReach`  of every leaf (8 rows): how far away a better row can be. Leaves without reach
///                 are copied.
/// 2. `window`     leaves of short reach look at every row in reach, both ways at once;
/// 3. `divide`     leaves of longer reach: search the middle row, and note where its lanes found
///                 their best. Rows before it need not look beyond the last of these places, rows
///                 behind it not before the first. Depth is log2(rows), so at most 31 (rows fit an
///                 int).
///
/// Of equally good rows the first one wins. That choice is monotone too, so it survives step 3.
/// Cost: O(rows log reach) per line when the lines of a run are alike, O(rows reach) at worst.
/// Plain windows for all leaves took 2.3 times as long on solids (dragon-512). To search outwards
/// from the best of the leaf before was as fast on dragon-512, and 7% slower on fandisk-512.
///
/// An Op (MinPlus.cc, MaxPlus.cc) supplies Value, penalty(d), candidate(), better(), best(),
/// bestOfThree() for one row on either side, load(), store() and leafReach(). If store() needs
/// offsets to the best row, they are kept beside the values (kTracksOffset), or the values hold
/// them (kOffsetInKey) and offsetOf() extracts them. This header is compiled once for each
/// instruction set.

#if defined(SPHERETREE_ENVELOPE_SEARCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHERETREE_ENVELOPE_SEARCH_INL_H
#undef SPHERETREE_ENVELOPE_SEARCH_INL_H
#else
#define SPHERETREE_ENVELOPE_SEARCH_INL_H
#endif

#include "LeafRows.h"
#include <openvdb_spheretree/base/IntegerRoot.h>

#include <hwy/highway.h>

#include <algorithm>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class Op>
class EnvelopeSearch {
public:
    using Value = typename Op::Value;
    using D = hn::CappedTag<Value, kLanes>;
    using V = hn::Vec<D>;

    /// @param op    its rows -1 and rows.count must be readable; lives until run() is done
    EnvelopeSearch(const Op& op, const RowRange& rows, EnvelopeScratch& scratch)
        : mOp(op), mRows(rows.count), mFirstLeaf(rows.first / kLeafDim),
          mEndLeaf(rows.last / kLeafDim), mScratch(scratch), mReach(scratch.reach)
    {
        mScratch.resize(mRows / kLeafDim);
    }

    void run()
    {
        for (mLane = 0; mLane < kLanes; mLane += kVectors * kWidth) {
            mOp.template leafReach<kVectors>(mLane, mScratch);
            for (int leaf = mFirstLeaf; leaf < mEndLeaf;) {
                if (mReach[leaf] == 0) {
                    copy(leaf++);
                    continue;
                }
                if (mReach[leaf] <= kWindowReach) {
                    window(leaf++);
                    continue;
                }
                const int first = leaf;
                while (leaf < mEndLeaf && mReach[leaf] > kWindowReach) ++leaf;
                divide(kLeafDim * first, kLeafDim * leaf - 1, -1, mRows);
            }
        }
    }

private:
    static constexpr int kWidth = int(hn::MaxLanes(D()));
    /// Vectors side by side that are searched together: they need not wait for each other's
    /// results.
    static constexpr int kVectors = kLanes / kWidth < 4 ? kLanes / kWidth : 4;
    /// Beyond this reach, dividing beats looking at every row (measured: 4 to 6 are alike).
    static constexpr int kWindowReach = 6;
    /// A span of candidates this short is not worth dividing (measured: 8 to 12 are alike).
    static constexpr int kDirectSpan = 10;

    HWY_INLINE V load(int row, int vector) const { return mOp.load(row, mLane + vector * kWidth); }

    /// Rows that are their own best.
    void copy(int leaf)
    {
        const V none = hn::Zero(D());
        for (int row = kLeafDim * leaf; row < kLeafDim * (leaf + 1); ++row) {
            for (int v = 0; v < kVectors; ++v) {
                mOp.store(row, mLane + v * kWidth, load(row, v), none);
            }
        }
    }

    /// Rows that look at every row in reach.
    void window(int leaf)
    {
        const int first = kLeafDim * leaf, last = first + kLeafDim - 1, reach = mReach[leaf];
        if (!Op::kTracksOffset && first - reach >= -1 && last + reach <= mRows) {
            switch (reach) {
            case 1: return around<1>(first);
            case 2: return around<2>(first);
            case 3: return around<3>(first);
            case 4: return around<4>(first);
            case 5: return around<5>(first);
            default: return around<6>(first);
            }
        }
        for (int row = first; row <= last; row += 4) searchRows<4>(row, -1, mRows);
    }

    /// The rows of a leaf, each of which looks kReach rows both ways, all of them there.
    template <int kReach>
    void around(int first)
    {
        const D d;
        V before[kReach], behind[kReach]; // penalties of the row k + 1 before, and behind
        for (int k = 0; k < kReach; ++k) {
            before[k] = hn::Set(d, mOp.penalty(k + 1));
            behind[k] = hn::Set(d, mOp.penalty(-k - 1));
        }
        for (int row = first; row < first + kLeafDim; ++row) {
            for (int v = 0; v < kVectors; ++v) {
                V best = load(row, v);
                for (int k = 0; k < kReach; ++k) {
                    best = mOp.bestOfThree(
                        best, load(row - k - 1, v), before[k], load(row + k + 1, v), behind[k]);
                }
                mOp.store(row, mLane + v * kWidth, best, mOp.offsetOf(best));
            }
        }
    }

    /// Rows [first, last], whose best rows all lie in [low, high].
    void divide(int first, int last, int low, int high)
    {
        if (first > last) return;
        if (last - first < 4 || high - low <= kDirectSpan) {
            searchAll(first, last, low, high);
            return;
        }
        const int middle = (first + last) / 2;
        int firstBest, lastBest;
        searchMiddle(middle, low, high, firstBest, lastBest);
        divide(first, middle - 1, low, lastBest);
        divide(middle + 1, last, firstBest, high);
    }

    void searchAll(int first, int last, int low, int high)
    {
        for (; last - first >= 3; first += 4) searchRows<4>(first, low, high);
        if (last - first == 2) searchRows<3>(first, low, high);
        if (last - first == 1) searchRows<2>(first, low, high);
        if (last - first == 0) searchRows<1>(first, low, high);
    }

    /// N rows from `row` on, at most two leaves; candidates [low, high] within reach.
    template <int N>
    void searchRows(int row, int low, int high)
    {
        const int reach = std::max(mReach[row / kLeafDim], mReach[(row + N - 1) / kLeafDim]);
        low = std::max(low, row - reach);
        high = std::min(high, row + N - 1 + reach);
        for (int v = 0; v < kVectors; ++v) searchVector<N>(row, low, high, v);
    }

    template <int N>
    HWY_INLINE void searchVector(int row, int low, int high, int vector)
    {
        const D d;
        const V first = load(low, vector);
        V best[N], offset[N]; // from `row` to the best
        V penalty[N];         // of this candidate; row k + 1 takes over that of row k next
        for (int k = 0; k < N; ++k) {
            penalty[k] = hn::Set(d, mOp.penalty(row + k - low));
            best[k] = mOp.candidate(first, penalty[k]);
            offset[k] = hn::Set(d, Value(low - row));
        }
        for (int j = low + 1; j <= high; ++j) {
            const V value = load(j, vector);
            const V here = hn::Set(d, Value(j - row));
            for (int k = N - 1; k > 0; --k) penalty[k] = penalty[k - 1];
            penalty[0] = hn::Set(d, mOp.penalty(row - j));
            for (int k = 0; k < N; ++k) {
                const V next = mOp.candidate(value, penalty[k]);
                if (Op::kTracksOffset) {
                    offset[k] = hn::IfThenElse(mOp.better(next, best[k]), here, offset[k]);
                }
                best[k] = mOp.best(next, best[k]);
            }
        }
        for (int k = 0; k < N; ++k) {
            const V tracked = hn::Sub(offset[k], hn::Set(d, Value(k)));
            mOp.store(row + k, mLane + vector * kWidth, best[k],
                Op::kOffsetInKey ? mOp.offsetOf(best[k]) : tracked);
        }
    }

    /// One row, and between which rows its lanes found their best.
    void searchMiddle(int row, int low, int high, int& firstBest, int& lastBest)
    {
        const D d;
        const int reach = mReach[row / kLeafDim];
        low = std::max(low, row - reach);
        high = std::min(high, row + reach);
        // Offsets, as the number of a row need not fit a lane.
        V best[kVectors], offset[kVectors];
        const V firstPenalty = hn::Set(d, mOp.penalty(row - low));
        for (int v = 0; v < kVectors; ++v) {
            best[v] = mOp.candidate(load(low, v), firstPenalty);
            offset[v] = hn::Set(d, Value(low - row));
        }
        for (int j = low + 1; j <= high; ++j) {
            const V penalty = hn::Set(d, mOp.penalty(row - j)), here = hn::Set(d, Value(j - row));
            for (int v = 0; v < kVectors; ++v) {
                const V next = mOp.candidate(load(j, v), penalty);
                if (!Op::kOffsetInKey) {
                    offset[v] = hn::IfThenElse(mOp.better(next, best[v]), here, offset[v]);
                }
                best[v] = mOp.best(next, best[v]);
            }
        }
        const hn::RebindToSigned<D> ds;
        auto least = hn::Zero(ds), most = hn::Zero(ds);
        for (int v = 0; v < kVectors; ++v) {
            if (Op::kOffsetInKey) offset[v] = mOp.offsetOf(best[v]);
            mOp.store(row, mLane + v * kWidth, best[v], offset[v]);
            // A background voxel cuts its line, so it bounds both sides by itself.
            const auto background = hn::Eq(load(row, v), hn::Zero(d));
            const auto signedOffset = hn::BitCast(ds, hn::IfThenZeroElse(background, offset[v]));
            least = v == 0 ? signedOffset : hn::Min(least, signedOffset);
            most = v == 0 ? signedOffset : hn::Max(most, signedOffset);
        }
        firstBest = row + int(hn::GetLane(hn::MinOfLanes(ds, least)));
        lastBest = row + int(hn::GetLane(hn::MaxOfLanes(ds, most)));
    }

    const Op& mOp;
    int mRows, mFirstLeaf, mEndLeaf, mLane = 0;
    EnvelopeScratch& mScratch;
    std::vector<int>& mReach;
};

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
