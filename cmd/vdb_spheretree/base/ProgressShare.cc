// SPDX-License-Identifier: Apache-2.0
#include "ProgressShare.h"

#include <algorithm>
#include <cmath>

namespace command {

namespace {

constexpr double kShare = 0.15; // of what is left, for a stage that nothing is known about
constexpr double kBefore = 0.05, kAfter = 0.9;
constexpr double kExpected = 0.9;
/// Threads report a little out of order, and that begins no pass.
constexpr int kFall = 10;

/// @param x  passes so far
/// @return the part of a stage that is done: even at first, and never all of it.
double partOf(double x, double expected)
{
    if (x <= expected) return kExpected * x / expected;
    return 1 - (1 - kExpected) * expected / x;
}

} // namespace

void ProgressShare::startStage(const std::string& name)
{
    endStage();
    const bool isLongest = !mLongest.empty() && name == mLongest;
    const double limit = mLongest.empty() ? 1 : kBefore;
    mBegin = mDone;
    mEnd = isLongest ? kAfter : mBegin + kShare * std::max(0.0, limit - mBegin);
    mExpected = isLongest ? std::max(1, mPasses) : 1;
    if (isLongest) mLongest.clear();
    mInLongest = isLongest;
    mPass = mHighest = 0;
    mInStage = true;
}

void ProgressShare::endStage()
{
    if (mInStage) mDone = std::max(mDone, mEnd);
    mInStage = mInLongest = false;
}

void ProgressShare::report(int percent)
{
    if (!mInStage) startStage("");
    percent = std::clamp(percent, 0, 100);
    if (percent + kFall < mHighest) {
        ++mPass;
        mHighest = 0;
    }
    mHighest = std::max(mHighest, percent);
    const double part = partOf(mPass + mHighest / 100.0, mExpected);
    mDone = mBegin + (mEnd - mBegin) * part; // a pass never gives less than the one before
}

double ProgressShare::secondsLeft(double seconds) const
{
    const double end = mBegin + kExpected * (mEnd - mBegin);
    if (!mInLongest || mDone <= mBegin || mDone >= end) return -1;
    return seconds * (end - mDone) / (mDone - mBegin);
}

std::string roughSeconds(double seconds)
{
    if (seconds < 90) return std::to_string(std::max(1L, std::lround(seconds))) + " s";
    if (seconds < 90 * 60) return std::to_string(std::lround(seconds / 60)) + " min";
    return std::to_string(std::lround(std::min(seconds, 1e9) / 3600)) + " h";
}

} // namespace command
