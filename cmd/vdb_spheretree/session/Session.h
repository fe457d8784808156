// SPDX-License-Identifier: Apache-2.0
/// @file Session.h
/// @brief One run of a command line: the stack, and all else that its actions share.

#pragma once

#include "base/Progress.h"
#include "line/Action.h"
#include "line/Plan.h"
#include "Stack.h"

#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <tbb/global_control.h>

#include <iosfwd>
#include <memory>

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

    /// @throw CommandError, Interrupted: by the first action that fails
    void run(const std::vector<ActionCall>& line);

    /// @return whether the running action is the last of the line, so that nothing will need the
    ///         stack after it.
    bool isLastAction() const { return mIsLast; }

    /// Tables and lists go to stdout, or to stderr if data goes to stdout.
    std::ostream& textOut() const;
    /// Prints @a text there, or to another stream. A reader that stops reading (`| head`) is no error.
    /// @throw CommandError (output)
    void print(const std::string& text) { print(text, textOut()); }
    void print(const std::string& text, std::ostream& out);
    /// Prints a line on stderr if -verbose or -debug has been given.
    void remark(const std::string& line) { say(Verbosity::Verbose, "    ", line); }
    /// Prints a line on stderr unless -quiet has been given.
    void note(const std::string& line) { say(Verbosity::Normal, "vdb_spheretree: note: ", line); }
    /// Notes that nobody can tell whether a tree is whole, if that is so.
    void noteIfUnverified(const StackItem& item);
    /// As a note, for what may be a mistake.
    void warn(const std::string& line);

    const Plan& plan;
    Stack stack;
    Progress progress;
    Verbosity verbosity = Verbosity::Normal;
    Stopwatch total;
    StageSeconds seconds;
    std::unique_ptr<tbb::global_control> threads;

private:
    void runOne(const ActionCall& call);
    /// @param least  the verbosity from which on the line is printed
    void say(Verbosity least, const std::string& start, const std::string& line);

    bool mReaderIsGone = false, mIsLast = false;
};

/// @brief Check everything that can be checked before any work.
/// @throw CommandError
Plan checkLine(const std::vector<ActionCall>& line);

} // namespace command
