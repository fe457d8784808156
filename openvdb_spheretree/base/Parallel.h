// SPDX-License-Identifier: Apache-2.0
/// @file Parallel.h
/// @brief The one facade over oneTBB: parallel loops that can be interrupted, with scratch memory
/// per thread. The number of threads is never set here.

#pragma once

#include "Interrupted.h"

#include <openvdb/util/NullInterrupter.h>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>

namespace openvdb_spheretree::detail {

/// @throw Interrupted if @a interrupter (which may be null) wants the work to stop.
inline void checkInterrupt(openvdb::util::NullInterrupter* interrupter, int percent = -1)
{
    if (interrupter && interrupter->wasInterrupted(percent)) throw Interrupted();
}

/// How far a loop has come, as told to an interrupter.
class LoopProgress {
public:
    LoopProgress(std::size_t count, openvdb::util::NullInterrupter* interrupter)
        : mCount(count), mInterrupter(interrupter)
    {}
    /// @throw Interrupted
    void check()
    {
        const double all = double(std::max<std::size_t>(mCount, 1));
        checkInterrupt(mInterrupter, int(100.0 * double(mDone) / all));
    }
    void add(std::size_t done) { mDone.fetch_add(done, std::memory_order_relaxed); }

private:
    std::size_t mCount;
    openvdb::util::NullInterrupter* mInterrupter;
    std::atomic<std::size_t> mDone{0};
};

/// Calls body(i) for the places of a range, and asks the interrupter before the first, and again
/// whenever kAskEvery has passed: a range may be a large part of a loop. The clock is read after
/// every body that takes long, and after kMostAtOnce of those that do not.
template <typename Body>
void runRange(std::size_t begin, std::size_t end, LoopProgress& progress, const Body& body)
{
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds kAskEvery(20);
    constexpr std::size_t kMostAtOnce = 64;
    progress.check();
    Clock::time_point asked = Clock::now();
    for (std::size_t i = begin, atOnce = 1; i < end;) {
        const std::size_t first = i, last = std::min(end, i + atOnce);
        for (; i < last; ++i) body(i);
        progress.add(last - first);
        atOnce = std::min(2 * atOnce, kMostAtOnce);
        if (i == end) return;
        const Clock::time_point now = Clock::now();
        if (now - asked < kAskEvery) continue;
        progress.check();
        asked = now;
        atOnce = 1;
    }
}

/// Calls body(i) for i in [0, count). An exception in a body, Interrupted included, cancels the
/// loop and is passed on.
template <typename Body>
void parallelFor(std::size_t count, openvdb::util::NullInterrupter* interrupter, const Body& body)
{
    LoopProgress progress(count, interrupter);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count),
        [&](const auto& range) { runRange(range.begin(), range.end(), progress, body); });
}

/// The same with scratch memory, made by make(), for each thread that takes part: body(i, scratch).
template <typename Make, typename Body>
void parallelForWith(std::size_t count, openvdb::util::NullInterrupter* interrupter,
    const Make& make, const Body& body)
{
    tbb::enumerable_thread_specific<decltype(make())> scratches(make);
    LoopProgress progress(count, interrupter);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
        auto& scratch = scratches.local();
        runRange(range.begin(), range.end(), progress, [&](std::size_t i) { body(i, scratch); });
    });
}

/// The same where nothing is needed to make a Scratch.
template <typename Scratch, typename Body>
void parallelForWithScratch(
    std::size_t count, openvdb::util::NullInterrupter* interrupter, const Body& body)
{
    parallelForWith(
        count, interrupter, [] { return Scratch(); }, body);
}

/// Calls body(i, slot) for i in [0, count), at most @a slots at a time. Bodies that run at the same
/// time have different slots in [0, slots): indices of what is too large for every thread to have
/// one.
template <typename Body>
void parallelForWithSlots(std::size_t count, std::size_t slots,
    openvdb::util::NullInterrupter* interrupter, const Body& body)
{
    LoopProgress progress(count, interrupter);
    std::atomic<std::size_t> next{0};
    const auto work = [&](std::size_t slot) {
        try {
            for (std::size_t i = next++; i < count; i = next++) {
                progress.check();
                body(i, slot);
                progress.add(1);
            }
        } catch (...) {
            next = count; // nothing more for the others either
            throw;
        }
    };
    tbb::parallel_for(std::size_t(0), std::min(slots, count), work, tbb::simple_partitioner());
}

} // namespace openvdb_spheretree::detail
