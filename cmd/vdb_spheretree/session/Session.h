// SPDX-License-Identifier: Apache-2.0
/// @file Session.h
/// @brief One run of a command line: the stack, and all else that its actions share.

#pragma once

#include "base/Progress.h"
#include "files/InputStamp.h"
#include "line/Action.h"
#include "line/Plan.h"
#include "script/Script.h"
#include "Stack.h"

#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace command {

using openvdb_spheretree::detail::Stopwatch;

/// Seconds spent so far, by the whole line.
struct StageSeconds {
    double read = 0, mask = 0, error = 0, write = 0;
    openvdb_spheretree::StageSeconds build;
};

enum class Verbosity { Quiet, Normal, Verbose, Debug };

struct Session {
    explicit Session(const Plan& linePlan) : plan(linePlan) {}

    /// @throw CommandError, Interrupted
    void run(const Script& script);
    /// @throw CommandError that names the action, Interrupted
    void runOne(const ActionCall& call);

    /// @return whether the running action is the last of the line, so that nothing will need the
    ///         stack after it.
    bool isLastAction() const { return mIsLast; }
    void setIsLast(bool isLast) { mIsLast = isLast; }
    /// @param place  of the running action on the line
    void setPlace(size_t place) { mPlace = place; }

    /// While a frame runs: actions are shown with its name, and times count from its begin.
    class InFrame {
    public:
        /// @param name   of the frame, for the plan
        /// @param label  the same with its place among the others, to be shown
        InFrame(Session& session, const std::string& name, const std::string& label);
        ~InFrame();
        InFrame(const InFrame&) = delete;
        InFrame& operator=(const InFrame&) = delete;

    private:
        Session& mSession;
        std::string mName, mLabel; ///< those of before
    };

    /// While a loop runs. In a loop over the files of a sequence, all trees that an action makes must
    /// have voxels of one size. In any other loop they may have any size, even if that loop stands
    /// within a frame of a sequence.
    class InLoop {
    public:
        InLoop(Session& session, bool isSequence);
        ~InLoop();
        InLoop(const InLoop&) = delete;
        InLoop& operator=(const InLoop&) = delete;

    private:
        Session& mSession;
        std::map<size_t, double> mVoxels;
        std::map<size_t, double>* const mOuter;
    };

    /// @brief To be called before a tree is made.
    /// @param size  of its voxels
    /// @throw CommandError (input) if the action has made trees of other voxels in the frames before
    void requireVoxelsOfSequence(double size) const;
    /// To be called when it has been made: the frames after are held to it.
    void noteVoxelsOfSequence(double size);
    static bool areSameVoxels(double size, double other);
    /// @return what differs from the frames before, and how to have it the same.
    static std::string otherVoxelsText(double size, double before);

    /// Has parallel work take so many threads at most, until the program ends.
    void limitThreads(size_t count);

    /// @brief To be called after what has read values, and before what results from them is kept.
    /// @throw CommandError (input) if a file of @a inputs has been written to
    void requireUnchangedInputs() const;

    /// Tables and lists go to stdout, or to stderr if data goes to stdout.
    std::ostream& textOut() const;
    /// Prints @a text there, or to another stream. A reader that stops reading (`| head`) is no error.
    /// @throw CommandError (output)
    void print(const std::string& text) { print(text, textOut()); }
    void print(const std::string& text, std::ostream& out);
    /// Prints a line on stderr if -verbose or -debug has been given.
    void remark(const std::string& line) { say(Verbosity::Verbose, "    ", line); }
    /// Prints a line on stderr unless -quiet has been given.
    void tell(const std::string& line) { say(Verbosity::Normal, "", line); }
    /// The same as a note.
    void note(const std::string& line)
    {
        say(Verbosity::Normal, "vdb_spheretree: note: ", inFrame(line));
    }
    /// Notes that nobody can tell whether a tree is whole, if that is so.
    void noteIfUnverified(const StackItem& item);
    /// Warns that a file that this line reads is about to be written, if that is so.
    void warnIfReplaced(const std::string& path);
    /// Says once in which frame Ctrl-C came, with -quiet too.
    void tellInterrupted(const std::string& frame, const std::string& done);
    /// As a note, for what may be a mistake; with -quiet, too.
    void warn(const std::string& line);

    Plan plan;
    Stack stack;
    Progress progress;
    Verbosity verbosity = Verbosity::Normal;
    bool stopsAtErrors = false;                  ///< of frames (-onerror)
    std::vector<std::string> skippedFrames = {}; ///< of loops, by empty=skip
    /// Files whose values may not all be in memory yet.
    std::vector<InputStamp> inputs;
    /// The last tree of each name that was built with like=, without edges and cuts.
    std::map<std::string, std::shared_ptr<const openvdb_spheretree::SphereTree>> lastTrees;
    Stopwatch total;
    StageSeconds seconds;

private:
    std::string inFrame(const std::string& line) const
    {
        return mFrame.empty() ? line : mFrame + ": " + line;
    }
    /// @param least  the verbosity from which on the line is printed
    void say(Verbosity least, const std::string& start, const std::string& line);

    bool mReaderIsGone = false, mIsLast = false, mToldInterrupted = false;
    std::string mFrame; ///< empty outside of loops
    size_t mPlace = 0;  ///< of the running action
    /// Of the first frame's trees, by the place of the action; null outside of sequences.
    std::map<size_t, double>* mVoxels = nullptr;
};

} // namespace command
