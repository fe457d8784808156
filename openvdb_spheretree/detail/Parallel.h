// SPDX-License-Identifier: Apache-2.0
/// @file detail/Parallel.h
/// @brief The one facade over oneTBB: parallel loops that can be interrupted, with scratch memory
/// per thread. The number of threads is the caller's business, never set here.

#pragma once

#include "../Interrupted.h"

#include <openvdb/util/NullInterrupter.h>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace openvdb_spheretree {
namespace detail {

/// @throw Interrupted if @a interrupter (which may be null) wants the work to stop.
inline void checkInterrupt(openvdb::util::NullInterrupter* interrupter)
{
    if (interrupter && interrupter->wasInterrupted()) throw Interrupted();
}

/// Calls body(i) for i in [0, count). An exception in a body, Interrupted included, cancels the
/// loop and is passed on.
template <typename Body>
void parallelFor(std::size_t count, openvdb::util::NullInterrupter* interrupter, const Body& body)
{
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
        checkInterrupt(interrupter);
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
    });
}

/// The same with a Scratch object for each thread that takes part: body(i, scratch).
template <typename Scratch, typename Body>
void parallelForWithScratch(
    std::size_t count, openvdb::util::NullInterrupter* interrupter, const Body& body)
{
    tbb::enumerable_thread_specific<Scratch> scratches;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
        checkInterrupt(interrupter);
        Scratch& scratch = scratches.local();
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i, scratch);
    });
}

} // namespace detail
} // namespace openvdb_spheretree
