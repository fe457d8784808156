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
    void check() { checkInterrupt(mInterrupter, int(100.0 * double(mDone) / double(mCount))); }
    void add(std::size_t done) { mDone.fetch_add(done, std::memory_order_relaxed); }

private:
    std::size_t mCount;
    openvdb::util::NullInterrupter* mInterrupter;
    std::atomic<std::size_t> mDone{0};
};

/// Calls body(i) for i in [0, count). An exception in a body, Interrupted included, cancels the
/// loop and is passed on.
template <typename Body>
void parallelFor(std::size_t count, openvdb::util::NullInterrupter* interrupter, const Body& body)
{
    LoopProgress progress(count, interrupter);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
        progress.check();
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
        progress.add(range.size());
    });
}

/// The same with scratch memory, made by make(), for each thread that takes part: body(i, scratch).
template <typename Make, typename Body>
void parallelForWith(std::size_t count, openvdb::util::NullInterrupter* interrupter,
    const Make& make, const Body& body)
{
    tbb::enumerable_thread_specific<decltype(make())> scratches(make);
    LoopProgress progress(count, interrupter);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
        progress.check();
        auto& scratch = scratches.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i, scratch);
        progress.add(range.size());
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
