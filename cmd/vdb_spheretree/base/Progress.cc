// SPDX-License-Identifier: Apache-2.0
#include "Progress.h"

#include "LastWords.h"
#include "Terminal.h"

#include <algorithm>
#include <csignal>
#include <iostream>

namespace command {

namespace {

constexpr double kSoonest = 3; // seconds; before that nobody can say how long it will take

void stopBySignal(int)
{
    // By the first signal alone: more of them would put the end off.
    if (requestStop()) startCountdown();
}

int64_t ticks(std::chrono::steady_clock::time_point time)
{
    return time.time_since_epoch().count();
}

double secondsSince(std::chrono::steady_clock::time_point begin)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// @return "43%, about 20 s left", as far as that can be said.
std::string howFar(const ProgressState& state)
{
    if (state.done <= 0) return roughSeconds(state.seconds) + " so far";
    const std::string text = std::to_string(int(100 * state.done)) + "%";
    const bool tellsTime = state.left >= 0 && state.seconds >= kSoonest && state.done < 1;
    return text + (tellsTime ? ", about " + roughSeconds(state.left) + " left" : "");
}

} // namespace

void catchSignals()
{
    struct sigaction action = {};
    action.sa_handler = stopBySignal; // without SA_RESTART: a read that waits is to come back
    sigemptyset(&action.sa_mask);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
        struct sigaction before = {};
        sigaction(number, nullptr, &before);
        // What is ignored stays so: nohup, and Ctrl-C of what a script runs in the background.
        if (before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
    }
    endOverdueStops();
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

ProgressStyle ProgressStyle::ofStderr()
{
    using std::chrono::milliseconds;
    constexpr milliseconds kTen(10000);
    if (!isTerminal(std::cerr)) return {false, kTen, kTen, kTen};
    return {true, milliseconds(500), milliseconds(100), kTen};
}

std::string progressText(const ProgressState& state)
{
    return state.label + (state.stage.empty() ? "" : " | " + state.stage) + ": " + howFar(state);
}

std::string progressBar(const ProgressState& state, size_t columns)
{
    constexpr size_t kBar = 20, kLongestStage = 30, kLeastLabel = 14; // the name of an action
    const size_t room = columns > 0 ? columns - 1 : 0; // in the last column some terminals wrap
    const std::string far = " " + howFar(state);
    std::string bar;
    if (state.done > 0) {
        const auto full = size_t(kBar * std::min(state.done, 1.0));
        bar = " [" + std::string(full, '#') + std::string(kBar - full, ' ') + "]";
    }
    std::string what = state.stage.empty() ? "" : " | " + cutToColumns(state.stage, kLongestStage);
    // What a narrow terminal goes without, in this order.
    if (kLeastLabel + columnsOf(what) + bar.size() + far.size() > room) bar.clear();
    if (kLeastLabel + columnsOf(what) + far.size() > room) what.clear();
    const size_t rest = columnsOf(what) + bar.size() + far.size();
    const std::string label = cutToColumns(state.label, room > rest ? room - rest : 0);
    return cutToColumns(label + what + bar + far, room);
}

Progress::Progress(const ProgressStyle& style) : mStyle(style) {}

void Progress::beginAction(const std::string& label, const LongWork& work)
{
    const std::lock_guard<std::mutex> lock(mMutex);
    mLabel = label;
    mStage.clear();
    mAdvice = work.advice;
    mShare = ProgressShare(work);
    mDepth = 0;
    mPercent = -1;
    mBegin = Clock::now();
    mNextTime = ticks(mBegin + mStyle.quiet);
}

void Progress::clearLine()
{
    const std::lock_guard<std::mutex> lock(mMutex);
    erase();
}

void Progress::endAction(bool complete)
{
    const std::lock_guard<std::mutex> lock(mMutex);
    if (mDrawn && complete) draw(true);
    erase();
    mLabel.clear();
}

void Progress::start(const char* name)
{
    if (!mEnabled) return;
    const std::lock_guard<std::mutex> lock(mMutex);
    if (mDepth++ > 0) return; // the outermost name is the one that says what is going on
    mStage = name ? name : "";
    mStageBegin = Clock::now();
    mShare.startStage(mStage);
    mPercent = -1;
}

void Progress::end()
{
    if (!mEnabled) return;
    const std::lock_guard<std::mutex> lock(mMutex);
    if (mDepth == 1) mShare.endStage();
    mDepth = std::max(0, mDepth - 1);
}

bool Progress::wasInterrupted(int percent)
{
    if (mEnabled.load(std::memory_order_relaxed)) follow(percent);
    return stopRequested();
}

/// Nobody waits for the mutex here: a percentage that is missed is followed by others.
void Progress::follow(int percent)
{
    if (percent >= 0 && percent != mPercent.load(std::memory_order_relaxed)) {
        const std::unique_lock<std::mutex> lock(mMutex, std::try_to_lock);
        if (lock && mDepth <= 1) {
            mPercent = percent;
            mShare.report(percent);
        }
    }
    const auto now = Clock::now();
    int64_t next = mNextTime.load(std::memory_order_relaxed);
    if (ticks(now) < next) return;
    // Only one thread gets past this.
    if (!mNextTime.compare_exchange_strong(next, ticks(now + mStyle.every))) return;
    const std::unique_lock<std::mutex> lock(mMutex, std::try_to_lock);
    if (lock && !mLabel.empty()) showNow();
}

void Progress::showNow()
{
    if (!mAdvice.empty() && Clock::now() - mBegin >= mStyle.advice) {
        erase();
        std::cerr << "vdb_spheretree: note: " << mAdvice << std::endl;
        mAdvice.clear();
    }
    if (mStyle.bar) draw(false);
    else std::cerr << progressText(state()) << std::endl;
}

ProgressState Progress::state() const
{
    const double left = mShare.secondsLeft(secondsSince(mStageBegin));
    return {mLabel, mStage, mShare.done(), secondsSince(mBegin), left};
}

/// The terminal is asked each time: its size may have changed, and a handler of SIGWINCH would wake
/// reads that wait.
void Progress::draw(bool complete)
{
    ProgressState now = state();
    if (complete) now.done = 1;
    constexpr size_t kUsual = 80; // of terminals that do not say
    const size_t columns = terminalColumns(std::cerr);
    std::cerr << "\r\033[K" << progressBar(now, columns ? columns : kUsual) << std::flush;
    mDrawn = true;
}

void Progress::erase()
{
    if (mDrawn) std::cerr << "\r\033[K" << std::flush;
    mDrawn = false;
}

} // namespace command
