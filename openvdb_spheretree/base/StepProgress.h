// SPDX-License-Identifier: Apache-2.0
/// @file StepProgress.h
/// @brief Many loops as one percentage that never falls: work in steps whose costs are known before, about.

#pragma once

#include <openvdb/util/NullInterrupter.h>

#include <algorithm>
#include <atomic>

namespace openvdb_spheretree::detail {

/// Stands between loops and an interrupter. What a loop says of itself becomes a part of the step that
/// it is in. Loops in a stage of a step (Stage.h) are details: the step itself says how far it is.
///
/// Steps begin and end on one thread. Any thread may ask; one that is late may pass on what it knew before.
class StepProgress : public openvdb::util::NullInterrupter {
public:
    /// @param to  is told percentages, and says when to stop; may be null
    explicit StepProgress(openvdb::util::NullInterrupter* to) : mTo(to) {}

    /// Adds to what all steps together cost, in any unit. A guess is enough.
    void expect(double cost) { mCost += cost; }

    void start(const char* = nullptr) override { ++mDepth; }
    void end() override { --mDepth; }
    bool wasInterrupted(int percent = -1) override
    {
        if (mDepth == 0 && percent >= 0) report(mDone + mStep * std::min(percent, 100) / 100);
        return mTo && mTo->wasInterrupted(mPercent);
    }

private:
    friend class Step;

    void report(double done)
    {
        constexpr double kMost = 99; // the rest is for what was not thought of
        if (!(mCost > 0)) return;
        const int percent = int(std::min(kMost, 100 * done / mCost));
        int highest = mPercent;
        while (percent > highest && !mPercent.compare_exchange_weak(highest, percent)) {}
    }

    openvdb::util::NullInterrupter* const mTo;
    double mCost = 0;
    double mDone = 0, mStep = 0; ///< costs: of the steps before, and of the one that runs
    std::atomic<int> mDepth{0};  ///< of stages in the step
    std::atomic<int> mPercent{0};
};

/// A step, from its construction to its end. Steps in a step are details.
class Step {
public:
    /// @param progress  may be null
    Step(StepProgress* progress, double cost)
        : mProgress(progress), mCost(cost), mStage(progress && progress->mStep > 0)
    {
        if (!mProgress) return;
        if (mStage) mProgress->start();
        else mProgress->mStep = cost;
    }
    ~Step()
    {
        if (!mProgress) return;
        if (mStage) {
            mProgress->end();
            return;
        }
        mProgress->mDone += mCost;
        mProgress->mStep = 0;
        mProgress->report(mProgress->mDone);
    }
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;

private:
    StepProgress* const mProgress;
    const double mCost;
    const bool mStage; ///< of another step
};

} // namespace openvdb_spheretree::detail
