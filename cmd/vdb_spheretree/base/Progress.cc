// SPDX-License-Identifier: Apache-2.0
#include "Progress.h"

#include "LastWords.h"
#include "Terminal.h"

#include <openvdb_spheretree/base/Interrupted.h>

#include <algorithm>
#include <csignal>
#include <iostream>

namespace command {

namespace {

// Read by all threads, so an atomic rather than a sig_atomic_t; one without a lock may be stored to
// in a signal handler just as well.
std::atomic<bool> sStop{false};
static_assert(std::atomic<bool>::is_always_lock_free);

constexpr auto kQuietTime = std::chrono::milliseconds(500);
constexpr auto kDrawEvery = std::chrono::milliseconds(100);

void requestStop(int)
{
    // By the first signal alone: more of them would put the end off.
    if (!sStop.exchange(true)) startCountdown();
}

} // namespace

void catchSignals()
{
    struct sigaction action = {};
    action.sa_handler = requestStop; // without SA_RESTART: a read that waits is to come back
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    struct sigaction before = {};
    sigaction(SIGHUP, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr); // nohup stays in force
    endOverdueStops();
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

bool stopRequested() { return sStop.load(std::memory_order_relaxed); }

void throwIfStopped()
{
    if (stopRequested()) throw openvdb_spheretree::Interrupted();
}

Progress::Progress() : mTerminal(isTerminal(std::cerr)), mEnabled(mTerminal) {}

void Progress::beginAction(const std::string& label)
{
    const std::lock_guard<std::mutex> lock(mMutex);
    mLabel = label;
    mStage.clear();
    mDepth = 0;
    mPercent = -1;
    mNextDraw = (Clock::now() + kQuietTime).time_since_epoch().count();
}

void Progress::clearLine()
{
    const std::lock_guard<std::mutex> lock(mMutex);
    erase();
}

void Progress::endAction()
{
    const std::lock_guard<std::mutex> lock(mMutex);
    erase();
    mLabel.clear();
}

void Progress::start(const char* name)
{
    if (!mEnabled) return;
    const std::lock_guard<std::mutex> lock(mMutex);
    if (mDepth++ > 0) return; // the outermost name is the one that says what is going on
    mStage = name ? name : "";
    mPercent = -1;
}

void Progress::end()
{
    if (!mEnabled) return;
    const std::lock_guard<std::mutex> lock(mMutex);
    mDepth = std::max(0, mDepth - 1);
}

bool Progress::wasInterrupted(int percent)
{
    if (mEnabled) draw(percent);
    return stopRequested();
}

void Progress::draw(int percent)
{
    if (percent >= 0) mPercent.store(std::min(percent, 100), std::memory_order_relaxed);
    const auto now = Clock::now().time_since_epoch().count();
    int64_t next = mNextDraw.load(std::memory_order_relaxed);
    if (now < next) return;
    const int64_t after = now + Clock::duration(kDrawEvery).count();
    if (!mNextDraw.compare_exchange_strong(next, after)) return; // another thread draws
    const std::unique_lock<std::mutex> lock(mMutex, std::try_to_lock);
    if (!lock || mLabel.empty()) return;
    std::string line = "\r\033[K" + mLabel.substr(0, 50);
    if (!mStage.empty()) line += " | " + mStage.substr(0, 30);
    const int done = mPercent.load(std::memory_order_relaxed);
    if (done >= 0) {
        line += " [" + std::string(size_t(done / 5), '#') + std::string(size_t(20 - done / 5), ' ')
            + "] " + std::to_string(done) + "%";
    } else {
        line += " ...";
    }
    std::cerr << line << std::flush;
    mDrawn = true;
}

void Progress::erase()
{
    if (mDrawn) std::cerr << "\r\033[K" << std::flush;
    mDrawn = false;
}

} // namespace command
