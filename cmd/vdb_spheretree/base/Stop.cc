// SPDX-License-Identifier: Apache-2.0
#include "Stop.h"

#include <openvdb_spheretree/base/Interrupted.h>

#include <atomic>

namespace command {

namespace {

// Read by all threads, so an atomic rather than a sig_atomic_t; one without a lock may be stored to
// in a signal handler just as well.
std::atomic<bool> sStop{false};
static_assert(std::atomic<bool>::is_always_lock_free);

std::atomic<bool (*)()> sQuestion{nullptr};

} // namespace

bool requestStop() noexcept { return !sStop.exchange(true); }

void setStopQuestion(bool (*isStopped)()) noexcept { sQuestion = isStopped; }

bool stopRequested()
{
    if (sStop.load(std::memory_order_relaxed)) return true;
    bool (*const isStopped)() = sQuestion.load(std::memory_order_relaxed);
    return isStopped && isStopped();
}

void throwIfStopped()
{
    if (stopRequested()) throw openvdb_spheretree::Interrupted();
}

} // namespace command
