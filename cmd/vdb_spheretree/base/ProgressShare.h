// SPDX-License-Identifier: Apache-2.0
/// @file ProgressShare.h
/// @brief How stages that come one by one, nobody knows how many, become one bar that never falls.
///
/// 1. A stage takes a fixed share of what is left of the bar. Those before the stage that is known to
///    take longest share the first kBefore of the bar; that one goes on to kAfter.
/// 2. Within a stage, a percentage that falls begins another pass. The passes that are expected fill
///    kExpected of the stage's part evenly, any others creep towards its end.
///
/// So it is a rule and no measurement: it is as even as the longest stage is, and jumps where a stage
/// ends early. The time that is left is told while the stage runs that is known to take longest, by its pace
/// so far.

#pragma once

#include <string>

namespace command {

/// What is known of an action before it runs.
struct LongWork {
    std::string stage;  ///< the one that takes longest, by its name; empty if none is known to
    int passes = 1;     ///< how many there are of its loops, about
    std::string advice; ///< what would take less time, to be said of long work; may be empty
};

class ProgressShare {
public:
    explicit ProgressShare(const LongWork& work = {}) : mLongest(work.stage), mPasses(work.passes)
    {}

    /// @name Stages, one after the other. Percentages in between are a stage without a name.
    /// @{
    void startStage(const std::string& name);
    void endStage();
    /// @}
    /// @param percent  of the stage's loop that runs, 0 to 100
    void report(int percent);

    /// @return from 0 to 1, and never less than before.
    double done() const { return mDone; }
    /// @return seconds until the end of the stage that is known to take longest, while it runs and has
    ///         no more passes than expected; else negative.
    /// @param seconds  since its begin
    double secondsLeft(double seconds) const;

private:
    std::string mLongest; ///< emptied when it begins
    int mPasses, mExpected = 1;
    double mDone = 0, mBegin = 0, mEnd = 0; ///< the last two: the part of the stage that runs
    int mPass = 0, mHighest = 0;
    bool mInStage = false, mInLongest = false;
};

/// @return "3 min" or so, for what is not known any better.
std::string roughSeconds(double seconds);

} // namespace command
