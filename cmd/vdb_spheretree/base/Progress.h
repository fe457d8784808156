// SPDX-License-Identifier: Apache-2.0
/// @file Progress.h
/// @brief The interrupter that the command passes to all long work: Ctrl-C stops it cleanly, and a
/// terminal shows how far it is.

#pragma once

#include <openvdb/util/NullInterrupter.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace command {

/// @brief Let Ctrl-C, SIGTERM and a closed terminal ask for a clean stop, and let a closed pipe or
/// a full file be an error that is reported rather than a signal that kills.
void catchSignals();

/// @return whether the user has asked for a stop.
bool stopRequested();

/// @throw openvdb_spheretree::Interrupted if the user has asked for a stop
void throwIfStopped();

/// Work asks from many threads, many times a second: asking is one relaxed load unless there is a
/// bar to draw, and the bar is drawn at most ten times a second.
class Progress : public openvdb::util::NullInterrupter {
public:
    Progress();

    /// @name What stands before the bar; begin shows nothing before half a second has gone
    /// @{
    void beginAction(const std::string& label);
    void endAction();
    /// @}
    void clearLine(); ///< before something else is printed; the bar comes back by itself
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
