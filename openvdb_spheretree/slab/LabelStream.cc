// SPDX-License-Identifier: Apache-2.0
#include "LabelStream.h"

#include "../SphereTreeSettings.h"
#include "../detail/Memory.h"
#include "../detail/Parallel.h"
#include "../detail/StageTimer.h"
#include "ColumnPower.h"
#include "LargestRadius.h"
#include "SlabBalls.h"
#include "SlabDistance.h"
#include "SlabPower.h"
#include "SlabPool.h"
#include "StreamWindow.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace openvdb_spheretree {
namespace slab {

namespace {

using openvdb::util::NullInterrupter;

/// What each slab is asked.
class Questions {
public:
    Questions(const LeafLayout& layout, std::vector<PowerMap::Voxel>& asked)
        : mAsked(asked), mOfSlab(layout.slabCount())
    {
        for (std::size_t i = 0; i < asked.size(); ++i) {
            if (asked[i].leaf == kNoLeaf) continue;
            mOfSlab[layout.slabOf(asked[i].leaf)].push_back(i);
        }
    }
    const std::vector<std::size_t>& ofSlab(uint32_t slab) const { return mOfSlab[slab]; }
    PowerMap::Voxel& voxel(std::size_t question) const { return mAsked[question]; }

private:
    std::vector<PowerMap::Voxel>& mAsked;
    std::vector<std::vector<std::size_t>> mOfSlab;
};

/// @tparam Power  of detail/MaxPlus.h
/// @tparam T      of squared distances
template <typename Power, typename T>
class Streaming {
public:
    Streaming(const LeafLayout& layout, int dim, std::vector<PowerMap::Voxel>& asked,
        const typename SlabPool<Power>::Steps& kept, uint32_t window, NullInterrupter* interrupter)
        : mLayout(layout), mDim(dim), mWindow(std::min(window, layout.slabCount())),
          mInterrupter(interrupter), mSteps(layout, interrupter), mQuestions(layout, asked),
          mPool(layout, dim, kept), mMaxDistSq(layout.slabCount()), mBalls(layout.slabCount())
    {
        mResult.centers.resize(layout.leafCount());
        mNextOfRun.resize(layout.runCount(Axis::X), 0);
        for (uint32_t i = 0; i < layout.runCount(Axis::X); ++i) {
            mFirstSlab.push_back(layout.slabOf(layout.run(Axis::X, i).leaves[0]));
        }
    }

    LevelBalls run()
    {
        while (mFinal < mLayout.slabCount()) {
            enter(std::min(mEntered + mWindow, mLayout.slabCount()));
            const uint32_t end = firstInDoubt();
            if (end == mFinal) continue;
            makeFinal(end);
            release();
        }
        return collected();
    }

private:
    struct Scratch {
        SlabDistance<T> distance;
        SlabPower<Power> power;
        double seconds = 0, powerSeconds = 0; ///< all, and those of power
    };
    struct ColumnScratch {
        Column<Power> column;
        ColumnPower<Power> power;
    };

    int32_t xOf(uint32_t slab) const { return mLayout.origin(mLayout.slab(slab).begin)[0]; }
    bool touchesNext(uint32_t slab) const
    {
        return slab + 1 < mLayout.slabCount() && xOf(slab) + kLeafDim == xOf(slab + 1);
    }
    static int64_t rootUp(uint32_t square) { return int64_t(std::ceil(std::sqrt(double(square)))); }

    void enter(uint32_t end)
    {
        const uint32_t first = mEntered;
        for (uint32_t slab = first; slab < end; ++slab) mPool.open(slab);
        double seconds = 0;
        detail::timed("distances and power labels", mInterrupter, &seconds, [&] {
            detail::parallelFor(end - first, mInterrupter, [&](std::size_t i) {
                Scratch& scratch = mScratch.local();
                const detail::Stage slab("", nullptr, &scratch.seconds);
                enterSlab(first + uint32_t(i), scratch);
            });
        });
        mEntered = end;
        share(seconds);
    }

    /// Distances and power run in turns: they share the time as the threads' times say.
    void share(double seconds)
    {
        double all = 0, power = 0;
        for (Scratch& scratch : mScratch) {
            all += std::exchange(scratch.seconds, 0);
            power += std::exchange(scratch.powerSeconds, 0);
        }
        const double part = all > 0 ? seconds * power / all : 0;
        mResult.seconds.power += part;
        mResult.seconds.distance += seconds - part;
    }

    void enterSlab(uint32_t slab, Scratch& scratch)
    {
        const SlabLabels<Power>& labels = mPool[slab];
        uint32_t largest = 0;
        scratch.power.open(mLayout, slab, mDim);
        scratch.distance.forEachRun(
            mLayout, slab, mSteps, mDim, [&](const LeafLayout::Run& run, const T* rows) {
                const detail::Stage stage("", nullptr, &scratch.powerSeconds);
                largest = std::max(largest,
                    mDim == 3 ? scratch.power.alongZ(run, rows, labels)
                              : scratch.power.fromY(run, rows, labels));
            });
        const detail::Stage stage("", nullptr, &scratch.powerSeconds);
        if (mDim == 3) scratch.power.alongY(mLayout, slab, labels);
        mMaxDistSq[slab] = largest;
    }

    /// @return the first slab that a ball to come may reach.
    uint32_t firstInDoubt() const
    {
        if (!touchesNext(mEntered - 1)) return mEntered;
        const int64_t end = int64_t(xOf(mEntered - 1)) + 7 - rootUp(mMaxDistSq[mEntered - 1]);
        uint32_t slab = mFinal;
        while (slab < mEntered && int64_t(xOf(slab)) + 7 <= end) ++slab;
        return slab;
    }

    void makeFinal(uint32_t end)
    {
        const detail::Stage stage("power labels along x", mInterrupter, &mResult.seconds.power);
        detail::parallelForWithScratch<ColumnScratch>(
            mLayout.runCount(Axis::X), mInterrupter, [&](std::size_t i, ColumnScratch& scratch) {
                if (!openColumn(uint32_t(i), end, scratch.column)) return;
                scratch.power.run(scratch.column, mLayout);
            });
        detail::parallelFor(
            end - mFinal, mInterrupter, [&](std::size_t i) { answer(mFinal + uint32_t(i)); });
        mFinal = end;
    }

    /// @param column  receives the leaves of run @a i in slabs that can matter
    /// @return whether it has leaves that become final.
    bool openColumn(uint32_t i, uint32_t end, Column<Power>& column)
    {
        const LeafLayout::Run run = mLayout.run(Axis::X, i);
        const uint32_t slab = mFirstSlab[i], next = mNextOfRun[i];
        if (next == run.count || slab + next >= end) return false;
        uint32_t begin = next;
        while (begin > 0 && mPool.isOpen(slab + begin - 1)) --begin;
        column.clear();
        column.first = next - begin;
        for (uint32_t k = begin; k < run.count && slab + k < mEntered; ++k) {
            if (slab + k < end) mNextOfRun[i] = k + 1;
            column.leaves.push_back(run.leaves[k]);
            column.labels.push_back(&mPool[slab + k]);
        }
        column.last = mNextOfRun[i] - begin;
        return true;
    }

    void answer(uint32_t slab)
    {
        for (const std::size_t question : mQuestions.ofSlab(slab)) {
            PowerMap::Voxel& voxel = mQuestions.voxel(question);
            const uint32_t before = voxel.leaf;
            voxel = moved(Axis::X, voxel, mPool[slab].dxOf(voxel.leaf)[voxel.offset]);
            const SlabLabels<Power>& there =
                voxel.leaf == before ? mPool[slab] : mPool[mLayout.slabOf(voxel.leaf)];
            voxel = moved(Axis::Y, voxel, there.dyOf(voxel.leaf)[voxel.offset]);
            if (mDim == 3) voxel = moved(Axis::Z, voxel, there.dzOf(voxel.leaf)[voxel.offset]);
        }
    }

    PowerMap::Voxel moved(Axis axis, PowerMap::Voxel voxel, int steps) const
    {
        return PowerMap::moved(mLayout, axis, voxel, steps);
    }

    void release()
    {
        const detail::Stage stage("medial balls", mInterrupter, &mResult.seconds.medial);
        std::vector<uint32_t> done;
        for (uint32_t slab = 0; slab < mFinal; ++slab) {
            if (mPool.isOpen(slab) && reachesNothing(slab)) done.push_back(slab);
        }
        detail::parallelFor(done.size(), mInterrupter, [&](std::size_t i) {
            const uint32_t slab = done[i];
            LeafMask* centers = mResult.centers.data() + mLayout.slab(slab).begin;
            mBalls[slab] = mCollect.local().collect(mLayout, slab, mPool[slab], centers);
        });
        for (const uint32_t slab : done) mPool.close(slab);
    }

    /// Whether no ball of a slab holds a voxel whose label is still to be found.
    bool reachesNothing(uint32_t slab) const
    {
        if (mFinal == mLayout.slabCount()) return true;
        return int64_t(xOf(slab)) + 7 + rootUp(mMaxDistSq[slab]) <= int64_t(xOf(mFinal));
    }

    LevelBalls collected()
    {
        std::size_t count = 0;
        for (const auto& balls : mBalls) count += balls.size();
        mResult.balls.reserve(count);
        for (auto& balls : mBalls) {
            mResult.balls.insert(mResult.balls.end(), balls.begin(), balls.end());
            std::vector<MedialBall>().swap(balls);
        }
        return std::move(mResult);
    }

    const LeafLayout& mLayout;
    const int mDim;
    const uint32_t mWindow;
    NullInterrupter* mInterrupter;
    const XSteps<StepOf<T>> mSteps;
    Questions mQuestions;
    tbb::enumerable_thread_specific<Scratch> mScratch;
    tbb::enumerable_thread_specific<SlabBalls<Power>> mCollect;
    SlabPool<Power> mPool;
    uint32_t mEntered = 0, mFinal = 0;           ///< slabs before these are
    std::vector<uint32_t> mMaxDistSq;            ///< of each slab
    std::vector<uint32_t> mFirstSlab;            ///< of each run along x
    std::vector<uint32_t> mNextOfRun;            ///< its first leaf that is not final
    std::vector<std::vector<MedialBall>> mBalls; ///< of each slab
    LevelBalls mResult;
};

/// @return the bytes that a stream may take unless told.
int64_t mostMemory()
{
    constexpr double kShare = 0.75;
    const double there = detail::physicalMemory();
    return there == 0 ? INT64_MAX : int64_t(kShare * there);
}

/// @param keeps  whether the steps of all voxels stay
template <typename Power, typename T>
StreamMemory memoryOf(const LeafLayout& layout, int dim, bool keeps)
{
    constexpr int64_t kKey = sizeof(typename Power::Key), kStep = sizeof(typename Power::Offset);
    const int64_t steps = kLeafVoxels * dim * kStep;
    const int64_t fixed = 2 * 64 * int64_t(sizeof(StepOf<T>)) + 2 * int64_t(sizeof(LeafMask));
    const int64_t perLeaf = kLeafVoxels * kKey + int64_t(sizeof(LeafMask));
    return {keeps ? perLeaf : perLeaf + steps,
        int64_t(layout.leafCount()) * (keeps ? fixed + steps : fixed)};
}

} // namespace

template <typename Power, typename T>
LevelBalls LabelStream::runWith(uint32_t largestDistSq, NullInterrupter* interrupter)
{
    const StreamMemory memory = memoryOf<Power, T>(mLayout, mDim, mKeep != nullptr);
    const uint32_t window = mWindow
        ? mWindow
        : windowWithin(mLayout, memory, largestDistSq, mMemory ? mMemory : mostMemory());
    typename SlabPool<Power>::Steps kept{};
    for (int axis = 0; mKeep && axis < mDim; ++axis) {
        kept[axis] = (*mKeep)[axis].template make<typename Power::Offset>(
            std::size_t(mLayout.leafCount()) * kLeafVoxels);
    }
    std::vector<PowerMap::Voxel> none;
    return Streaming<Power, T>(mLayout, mDim, mAsked ? *mAsked : none, kept, window, interrupter)
        .run();
}

LevelBalls LabelStream::run(NullInterrupter* interrupter)
{
    requireDim(mDim);
    const uint32_t largest = largestDistSq(mLayout, mDim, interrupter);
    requireRadius(largest);
    if (largest <= detail::NarrowPower::kMaxRadiusSq) {
        return runWith<detail::NarrowPower, uint16_t>(largest, interrupter);
    }
    return runWith<detail::WidePower, uint32_t>(largest, interrupter);
}

} // namespace slab
} // namespace openvdb_spheretree
