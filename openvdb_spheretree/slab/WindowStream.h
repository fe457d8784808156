// SPDX-License-Identifier: Apache-2.0
/// @file WindowStream.h
/// @brief A stream of labels that has a window of slabs in memory.
///
/// Slabs go through three states:
///
/// 1. *entered*: distances and the passes along z and y (StreamWork.h), many slabs in parallel;
///    what stays are keys and offsets;
/// 2. *final*: no ball of a slab that has not entered reaches it. Then its labels are found by the
///    pass along x, run by run, over the slabs of the window (ColumnPower.h), and its queries move
///    to the slabs that the labels lead to (LabelQueries.h);
/// 3. *released*: none of its balls reaches a slab that is not final. Then its medial balls and the
///    labels of its queries are known, and its memory goes to the next slab that enters.
///
/// Distances change by at most 1 from a voxel to the next. So if M is the largest distance in the
/// last slab that has entered, whose voxels end at x = e, no ball of a later slab reaches x <= e -
/// M; if that slab does not touch the next one, none reaches it at all. A slab with largest
/// distance m whose voxels end at x reaches nothing from x + m on.

#pragma once

#include "SlabLabels.h"
#include "StreamWork.h"
#include <openvdb_spheretree/base/IntegerRoot.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace openvdb_spheretree::slab {

/// The slabs of the window, and memory for them that is used again from slab to slab.
template <typename Power>
class SlabPool {
public:
    SlabPool(const LeafLayout& layout, int dim, const KeptOffsets<Power>& kept)
        : mLayout(layout), mDim(dim), mKept(kept), mOpen(layout.slabCount()),
          mMemory(layout.slabCount())
    {}

    const SlabLabels<Power>& operator[](uint32_t slab) const { return mOpen[slab]; }
    bool isOpen(uint32_t slab) const { return mOpen[slab].keys != nullptr; }

    /// Labels are undefined.
    void open(uint32_t slab)
    {
        const LeafLayout::Slab leaves = mLayout.slab(slab);
        mMemory[slab] = taken(leaves.size());
        mOpen[slab] = mMemory[slab].open(leaves, mDim, mKept);
    }
    void close(uint32_t slab)
    {
        mFree.push_back(std::move(mMemory[slab]));
        mOpen[slab] = {};
    }

private:
    /// @return the smallest free memory that is large enough, or new one.
    SlabMemory<Power> taken(uint32_t leaves)
    {
        auto best = mFree.end();
        for (auto it = mFree.begin(); it != mFree.end(); ++it) {
            if (it->leaves() < leaves) continue;
            if (best == mFree.end() || it->leaves() < best->leaves()) best = it;
        }
        SlabMemory<Power> memory;
        if (best != mFree.end()) {
            std::swap(*best, mFree.back());
            memory = std::move(mFree.back());
        }
        if (!mFree.empty()) mFree.pop_back(); // the one taken, or one too small: better given back
        return memory;
    }

    const LeafLayout& mLayout;
    const int mDim;
    const KeptOffsets<Power> mKept;
    std::vector<SlabLabels<Power>> mOpen;
    std::vector<SlabMemory<Power>> mMemory, mFree; ///< of open slabs, and of none
};

template <typename Power, typename T>
class WindowStream {
    using Work = StreamWork<Power, T>;

public:
    /// @param work     kept by reference
    /// @param window   slabs that enter at a time
    /// @param threads  that work on slabs, each with memory for one
    WindowStream(Work& work, uint32_t window, uint32_t threads)
        : mWork(work), mLayout(work.layout), mWindow(std::min(window, mLayout.slabCount())),
          mEntries(threads), mCollect(threads), mPool(mLayout, work.dim, work.kept),
          mLargestDistSq(mLayout.slabCount()), mNextOfRun(mLayout.runCount(Axis::X), 0)
    {}

    void run()
    {
        while (mFinal < mLayout.slabCount()) {
            enter(std::min(mEntered + mWindow, mLayout.slabCount()));
            const uint32_t end = firstInDoubt();
            if (end == mFinal) continue;
            makeFinal(end);
            release();
        }
    }

private:
    int32_t xOf(uint32_t slab) const { return mLayout.origin(mLayout.slab(slab).begin)[0]; }

    void enter(uint32_t end)
    {
        const uint32_t first = mEntered;
        for (uint32_t slab = first; slab < end; ++slab) mPool.open(slab);
        double seconds = 0;
        detail::timed("distances and power labels", mWork.interrupter, &seconds, [&] {
            detail::parallelForWithSlots(end - first, mEntries.size(), mWork.interrupter,
                [&](std::size_t i, std::size_t slot) {
                    const uint32_t slab = first + uint32_t(i);
                    mLargestDistSq[slab] = mWork.enter(slab, mPool[slab], mEntries[slot]);
                });
        });
        mEntered = end;
        mWork.share(seconds, mEntries);
    }

    /// @return the first slab that a ball to come may reach.
    uint32_t firstInDoubt() const
    {
        const uint32_t last = mEntered - 1;
        const bool touchesNext =
            mEntered < mLayout.slabCount() && int64_t(xOf(last)) + kLeafDim == xOf(mEntered);
        if (!touchesNext) return mEntered;
        const int64_t end = int64_t(xOf(last)) + 7 - detail::ceilSqrt(mLargestDistSq[last]);
        uint32_t slab = mFinal;
        while (slab < mEntered && int64_t(xOf(slab)) + 7 <= end) ++slab;
        return slab;
    }

    void makeFinal(uint32_t end)
    {
        const detail::Stage stage(
            "power labels along x", mWork.interrupter, &mWork.seconds().power);
        detail::parallelForWithScratch<ColumnPower<Power>>(mLayout.runCount(Axis::X),
            mWork.interrupter, [&](std::size_t i, ColumnPower<Power>& power) {
                if (!openColumn(uint32_t(i), end, power.column)) return;
                mWork.labelColumn(power);
            });
        mFinal = end;
    }

    /// @param column  receives the leaves of run @a i in slabs that can matter
    /// @return whether it has leaves that become final.
    bool openColumn(uint32_t i, uint32_t end, Column<Power>& column)
    {
        const LeafLayout::Run run = mLayout.run(Axis::X, i);
        const uint32_t slab = mWork.firstSlab(i), next = mNextOfRun[i];
        if (next == run.count || slab + next >= end) return false;
        uint32_t begin = next;
        while (begin > 0 && mPool.isOpen(slab + begin - 1)) --begin;
        column.clear();
        column.first = next - begin;
        for (uint32_t k = begin; k < run.count && slab + k < mEntered; ++k) {
            if (slab + k < end) mNextOfRun[i] = k + 1;
            column.add(run.leaves[k], mPool[slab + k].keysOf(run.leaves[k]));
        }
        column.last = mNextOfRun[i] - begin;
        return true;
    }

    void release()
    {
        const detail::Stage stage("medial balls", mWork.interrupter, &mWork.seconds().medial);
        std::vector<uint32_t> done;
        for (uint32_t slab = 0; slab < mFinal; ++slab) {
            if (mPool.isOpen(slab) && reachesNothing(slab)) done.push_back(slab);
        }
        detail::parallelForWithSlots(
            done.size(), mEntries.size(), mWork.interrupter, [&](std::size_t i, std::size_t slot) {
                mWork.finish(done[i], mPool[done[i]], mCollect[slot]);
            });
        for (const uint32_t slab : done) mPool.close(slab);
    }

    /// Whether no ball of a slab holds a voxel whose label is still to be found.
    bool reachesNothing(uint32_t slab) const
    {
        if (mFinal == mLayout.slabCount()) return true;
        const int64_t reach = detail::ceilSqrt(mLargestDistSq[slab]);
        return int64_t(xOf(slab)) + 7 + reach <= int64_t(xOf(mFinal));
    }

    Work& mWork;
    const LeafLayout& mLayout;
    const uint32_t mWindow;
    std::vector<typename Work::Entry> mEntries; ///< memory of each thread
    std::vector<SlabBalls<Power>> mCollect;     ///< the same
    SlabPool<Power> mPool;
    uint32_t mEntered = 0, mFinal = 0;    ///< slabs before these are
    std::vector<uint32_t> mLargestDistSq; ///< of each slab
    std::vector<uint32_t> mNextOfRun;     ///< its first leaf that is not final
};

} // namespace openvdb_spheretree::slab
