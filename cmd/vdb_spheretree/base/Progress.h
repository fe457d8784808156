// SPDX-License-Identifier: Apache-2.0
/// @file Progress.h
/// @brief The interrupter that all long work gets: Ctrl-C stops it cleanly, and a terminal shows its
/// progress.

#pragma once

#include <openvdb/util/NullInterrupter.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace command {

/// @brief Install signal handlers. Ctrl-C, SIGTERM and a closed terminal request a clean stop, and
/// end the program a second later if it has not stopped by then. A closed pipe and a full file become
/// errors that are reported, not signals that kill.
void catchSignals();

/// @return whether a stop has been requested.
bool stopRequested();

/// @throw openvdb_spheretree::Interrupted if a stop has been requested
void throwIfStopped();

/// Many threads call wasInterrupted() many times a second. It costs one relaxed load unless there is
/// a bar to draw, and the bar is drawn at most ten times a second.
class Progress : public openvdb::util::NullInterrupter {
public:
    Progress();

    /// @name The text before the bar. Nothing is shown in the first half second of an action.
    /// @{
    void beginAction(const std::string& label);
    void endAction();
    /// @}
    void clearLine(); ///< call before printing something else; the bar comes back by itself
    void setEnabled(bool enabled) { mEnabled = enabled && mTerminal; }

    void start(const char* name = nullptr) override;
    void end() override;
    bool wasInterrupted(int percent = -1) override;

private:
    using Clock = std::chrono::steady_clock;
    void draw(int percent);
    void erase();

    const bool mTerminal;
    std::atomic<bool> mEnabled;
    std::atomic<int64_t> mNextDraw{0}; ///< in ticks of the clock
    std::atomic<int> mPercent{-1};
    std::mutex mMutex; ///< guards what follows
    std::string mLabel, mStage;
    int mDepth = 0;
    bool mDrawn = false;
};

} // namespace command
