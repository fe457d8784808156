// SPDX-License-Identifier: Apache-2.0
/// @file EnvelopeSearch-inl.h
/// @brief One axis of a separable transform: for every row i, the best over all rows j of
/// value(j) "penalised by" (i - j)^2, for 64 lines side by side. Exact.
///
/// Both transforms are this search: the distance transform takes the smallest value + (i - j)^2,
/// the power map the largest value - (i - j)^2 (CM07, sections 2 and 3). Instead of building the
/// envelope of parabolas line by line, which is scalar work, it uses that the best j never moves
/// backwards as i grows (the penalty is convex), for all lanes of a vector at once:
///
/// 1. `reach`   of every block of 8 rows: how far away a better row can be at all; those of none
///              are copied;
/// 2. `window`  blocks of short reach look at every row in reach, both ways at once;
/// 3. `divide`  longer stretches: search the middle row, remembering where each lane found its best;
///              the rows before need not look beyond the last of these places, the rows behind not
///              before the first. Depth is log2(rows), so at most 31 (rows are counted in an int).
///
/// Of equally good rows the first one wins. That choice is monotone too, so it survives step 3.
/// Cost: O(rows log reach) per line when the lines of a run are alike, O(rows reach) at worst.
/// Plain windows for all blocks took 2.3 times as long on solids (dragon-512, with a prototype). To
/// go from one block to the next, finding the best of its first row outwards until no lane can gain,
/// was as fast on dragon-512 and 7% slower on fandisk-512.
///
/// An Op supplies: Value, penalty(d), candidate(), better(), best(), bestOfThree() for one row on
/// either side, load(), store(), blockReach(),
/// and whether store() wants steps: kTracksStep for steps beside the values, kStepInKey where the
/// values hold them and step() extracts them; see MinPlus.cc and MaxPlus.cc. This header is
/// compiled once per instruction set.

#if defined(SPHERETREE_ENVELOPE_SEARCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHERETREE_ENVELOPE_SEARCH_INL_H
#undef SPHERETREE_ENVELOPE_SEARCH_INL_H
#else
#define SPHERETREE_ENVELOPE_SEARCH_INL_H
#endif

#include "EnvelopeScratch.h"
#include "LeafRows.h"
#include <openvdb_spheretree/base/IntegerRoot.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <vector>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree {
namespace detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class Op>
class EnvelopeSearch {
public:
    using Value = typename Op::Value;
    using D = hn::CappedTag<Value, kLanes>;
    using V = hn::Vec<D>;

    /// @param op    its rows -1 and rows.count must be readable; lives until run() is done
    EnvelopeSearch(const Op& op, const RowRange& rows, EnvelopeScratch& scratch)
        : mOp(op), mRows(rows.count), mFirstBlock(rows.first / kBlockRows),
          mEndBlock(rows.last / kBlockRows), mScratch(scratch), mReach(scratch.reach)
    {
        mScratch.resize(mRows / kBlockRows);
    }

    void run()
    {
        for (mLane = 0; mLane < kLanes; mLane += kVectors * kWidth) {
            mOp.template blockReach<kVectors>(mLane, mScratch);
            for (int block = mFirstBlock; block < mEndBlock;) {
                if (mReach[block] == 0) {
                    copy(block++);
                    continue;
                }
                if (mReach[block] <= kWindowReach) {
                    window(block++);
                    continue;
                }
                const int first = block;
                while (block < mEndBlock && mReach[block] > kWindowReach) ++block;
                divide(kBlockRows * first, kBlockRows * block - 1, -1, mRows);
            }
        }
    }

private:
    static constexpr int kWidth = int(hn::MaxLanes(D()));
    /// Vectors side by side that are searched together: one waits for its own last step, several
    /// do not wait for each other's.
    static constexpr int kVectors = kLanes / kWidth < 4 ? kLanes / kWidth : 4;
    /// Beyond this reach, dividing beats looking at every row (measured: 4 to 6 are alike).
    static constexpr int kWindowReach = 6;
    /// A span of candidates this short is not worth dividing (measured: 8 to 12 are alike).
    static constexpr int kDirectSpan = 10;

    HWY_INLINE V load(int row, int vector) const { return mOp.load(row, mLane + vector * kWidth); }

    /// Rows that are their own best.
    void copy(int block)
    {
        const V none = hn::Zero(D());
        for (int row = kBlockRows * block; row < kBlockRows * (block + 1); ++row) {
            for (int v = 0; v < kVectors; ++v) {
                mOp.store(row, mLane + v * kWidth, load(row, v), none);
            }
        }
    }

    /// Rows that look at every row in reach.
    void window(int block)
    {
        const int first = kBlockRows * block, last = first + kBlockRows - 1, reach = mReach[block];
        if (!Op::kTracksStep && first - reach >= -1 && last + reach <= mRows) {
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

    /// The rows of a block, each of which looks kReach rows both ways, all of them there.
    template <int kReach>
    void around(int first)
    {
        const D d;
        V before[kReach], behind[kReach]; // what rows pay that are before, or behind, by k + 1
        for (int k = 0; k < kReach; ++k) {
            before[k] = hn::Set(d, mOp.penalty(k + 1));
            behind[k] = hn::Set(d, mOp.penalty(-k - 1));
        }
        for (int row = first; row < first + kBlockRows; ++row) {
            for (int v = 0; v < kVectors; ++v) {
                V best = load(row, v);
                for (int k = 0; k < kReach; ++k) {
                    best = mOp.bestOfThree(
                        best, load(row - k - 1, v), before[k], load(row + k + 1, v), behind[k]);
                }
                mOp.store(row, mLane + v * kWidth, best, mOp.step(best));
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

    /// N rows from `row` on, at most two blocks; candidates [low, high] within reach.
    template <int N>
    void searchRows(int row, int low, int high)
    {
        const int reach = std::max(mReach[row / kBlockRows], mReach[(row + N - 1) / kBlockRows]);
        low = std::max(low, row - reach);
        high = std::min(high, row + N - 1 + reach);
        for (int v = 0; v < kVectors; ++v) searchVector<N>(row, low, high, v);
    }

    template <int N>
    HWY_INLINE void searchVector(int row, int low, int high, int vector)
    {
        const D d;
        const V first = load(low, vector);
        V best[N], step[N]; // where the best is, as steps from `row`
        V penalty[N];       // of the candidate at hand; what row k pays now, k + 1 pays next
        for (int k = 0; k < N; ++k) {
            penalty[k] = hn::Set(d, mOp.penalty(row + k - low));
            best[k] = mOp.candidate(first, penalty[k]);
            step[k] = hn::Set(d, Value(low - row));
        }
        for (int j = low + 1; j <= high; ++j) {
            const V value = load(j, vector);
            const V here = hn::Set(d, Value(j - row));
            for (int k = N - 1; k > 0; --k) penalty[k] = penalty[k - 1];
            penalty[0] = hn::Set(d, mOp.penalty(row - j));
            for (int k = 0; k < N; ++k) {
                const V next = mOp.candidate(value, penalty[k]);
                if (Op::kTracksStep) {
                    step[k] = hn::IfThenElse(mOp.better(next, best[k]), here, step[k]);
                }
                best[k] = mOp.best(next, best[k]);
            }
        }
        for (int k = 0; k < N; ++k) {
            const V tracked = hn::Sub(step[k], hn::Set(d, Value(k)));
            mOp.store(row + k, mLane + vector * kWidth, best[k],
                Op::kStepInKey ? mOp.step(best[k]) : tracked);
        }
    }

    /// One row, and between which rows its lanes found their best.
    void searchMiddle(int row, int low, int high, int& firstBest, int& lastBest)
    {
        const D d;
        const int reach = mReach[row / kBlockRows];
        low = std::max(low, row - reach);
        high = std::min(high, row + reach);
        V best[kVectors], step[kVectors]; // a row's number need not fit a lane; steps do
        const V firstPenalty = hn::Set(d, mOp.penalty(row - low));
        for (int v = 0; v < kVectors; ++v) {
            best[v] = mOp.candidate(load(low, v), firstPenalty);
            step[v] = hn::Set(d, Value(low - row));
        }
        for (int j = low + 1; j <= high; ++j) {
            const V penalty = hn::Set(d, mOp.penalty(row - j)), here = hn::Set(d, Value(j - row));
            for (int v = 0; v < kVectors; ++v) {
                const V next = mOp.candidate(load(j, v), penalty);
                if (!Op::kStepInKey) {
                    step[v] = hn::IfThenElse(mOp.better(next, best[v]), here, step[v]);
                }
                best[v] = mOp.best(next, best[v]);
            }
        }
        const hn::RebindToSigned<D> ds;
        auto least = hn::Zero(ds), most = hn::Zero(ds);
        for (int v = 0; v < kVectors; ++v) {
            if (Op::kStepInKey) step[v] = mOp.step(best[v]);
            mOp.store(row, mLane + v * kWidth, best[v], step[v]);
            // A background voxel cuts its line, so it bounds both sides by itself.
            const auto background = hn::Eq(load(row, v), hn::Zero(d));
            const auto signedStep = hn::BitCast(ds, hn::IfThenZeroElse(background, step[v]));
            least = v == 0 ? signedStep : hn::Min(least, signedStep);
            most = v == 0 ? signedStep : hn::Max(most, signedStep);
        }
        firstBest = row + int(hn::GetLane(hn::MinOfLanes(ds, least)));
        lastBest = row + int(hn::GetLane(hn::MaxOfLanes(ds, most)));
    }

    const Op& mOp;
    int mRows, mFirstBlock, mEndBlock, mLane = 0;
    EnvelopeScratch& mScratch;
    std::vector<int>& mReach;
};

} // namespace HWY_NAMESPACE
} // namespace detail
} // namespace openvdb_spheretree
HWY_AFTER_NAMESPACE();

#endif
