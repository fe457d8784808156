// SPDX-License-Identifier: Apache-2.0
/// @file Call.h
/// @brief Long work under Python: the GIL is free, Ctrl-C stops it, and a function is told how far it is.
///
/// The work runs on a thread of its own. The calling thread waits, and looks every 50 ms for signals (which
/// Python hands out on its main thread alone) and for news to tell. So whatever the work does, Python's
/// functions are called by the thread that made the call, and by no other.

#pragma once

#include "base/ProgressShare.h"

#include <openvdb/util/NullInterrupter.h>
#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <utility>

namespace binding {

struct [[gnu::visibility("hidden")]] CallSettings
{ // as all of pybind11 is
    /// None, or called with the fraction that is done, 0 to 1, which never falls, and the name of the
    /// stage. An exception that it raises stops the work.
    pybind11::object progress = pybind11::none();
    int threads = 0; ///< the most that the work may run on; 0: as many as there are cores
    command::LongWork work = {}; ///< what is known of its length
};

using Interrupter = openvdb::util::NullInterrupter;

/// @brief Run @a work, which may not touch Python. To be called with the GIL.
/// @throw what @a work throws; pybind11::error_already_set for Ctrl-C, and for what `progress` raises;
///        InputError for a number of threads that is none
void runCall(const CallSettings& settings, const std::function<void(Interrupter*)>& work);

/// @brief The same of work that is over in a moment, on the calling thread: to start one takes longer than most questions to a
/// tree. Ctrl-C waits. With a function for `progress` it is runCall().
void runBriefly(const CallSettings& settings, const std::function<void(Interrupter*)>& work);

/// @return what @a work returns.
template <typename Work>
auto resultOfCall(const CallSettings& settings, const Work& work)
{
    std::optional<decltype(work(std::declval<Interrupter*>()))> result;
    runCall(settings, [&](Interrupter* interrupter) { result.emplace(work(interrupter)); });
    return std::move(*result);
}

} // namespace binding
