// SPDX-License-Identifier: Apache-2.0
/// @file Progress.h
/// @brief The interrupter that all long work gets: Ctrl-C stops it cleanly, a terminal shows its
/// progress, and a log gets a line of it now and then.

#pragma once

#include "ProgressShare.h"
#include "Stop.h"

#include <openvdb/util/NullInterrupter.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace command {

/// @brief Install signal handlers. Ctrl-C, SIGTERM, a closed terminal and a limit of processor time request a clean stop, and
/// end the program a second later if it has not stopped by then; those of them that whoever started it had
/// ignored stay ignored. A closed pipe and a full file become
/// errors that are reported, not signals that kill.
void catchSignals();

/// How progress is shown.
struct ProgressStyle {
    bool bar;                         ///< one line that is drawn again, or a line each time
    std::chrono::milliseconds quiet;  ///< nothing is shown before
    std::chrono::milliseconds every;  ///< from one time to the next
    std::chrono::milliseconds advice; ///< then the action's advice is printed, once

    /// For what stderr is: a terminal has a bar after half a second, a log a line every ten seconds.
    static ProgressStyle ofStderr();
};

/// What there is to say of an action.
struct ProgressState {
    std::string label;  ///< what the user has typed
    std::string stage;  ///< may be empty
    double done = 0;    ///< 0 to 1; 0 also if nothing is known
    double seconds = 0; ///< since its begin
    double left = -1;   ///< seconds; negative if nobody knows
};

/// @return all of it with a bar, on one line of fewer than @a columns: the label is cut first.
std::string progressBar(const ProgressState& state, size_t columns);
/// @return all of it without a bar.
std::string progressText(const ProgressState& state);

/// Many threads call wasInterrupted() many times a second. It costs one relaxed load and one look at
/// the clock, unless there is a bar to draw.
///
/// Percentages count outside of all stages and in the outermost ones (ProgressShare.h says how they
/// add up); those of stages within a stage are details of its own.
class Progress : public openvdb::util::NullInterrupter {
public:
    explicit Progress(const ProgressStyle& style = ProgressStyle::ofStderr());

    /// @name An action from its begin to its end. Nothing is shown outside.
    /// @{
    void beginAction(const std::string& label, const LongWork& work = {});
    void endAction(bool complete); ///< @param complete  whether its bar is to be seen full before
    /// @}
    void clearLine(); ///< call before printing something else; the bar comes back by itself
    void setEnabled(bool enabled) { mEnabled = enabled; }

    void start(const char* name = nullptr) override;
    void end() override;
    bool wasInterrupted(int percent = -1) override;

private:
    using Clock = std::chrono::steady_clock;
    void follow(int percent);
    void showNow();
    void draw(bool complete);
    ProgressState state() const;
    void erase();

    const ProgressStyle mStyle;
    std::atomic<bool> mEnabled{true};
    std::atomic<int64_t> mNextTime{0}; ///< in ticks of the clock
    std::atomic<int> mPercent{-1};     ///< the last that was taken notice of
    std::mutex mMutex;                 ///< guards what follows
    Clock::time_point mBegin, mStageBegin;
    std::string mLabel, mStage, mAdvice;
    ProgressShare mShare;
    int mDepth = 0;
    bool mDrawn = false;
};

} // namespace command
