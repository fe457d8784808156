// SPDX-License-Identifier: Apache-2.0
/// @file Session.h
/// @brief One run of a command line: the stack, and what its actions share.

#pragma once

#include "base/Progress.h"
#include "line/Action.h"
#include "line/Plan.h"
#include "Stack.h"

#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/base/Stopwatch.h>
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
    explicit Session(const Plan& plan) : plan(plan) {}

    /// @throw CommandError, Interrupted: by the first action that fails
    void run(const std::vector<ActionCall>& line);

    /// @return whether the action that runs is the line's last: nothing can ask for what is on the
    /// stack any more.
    bool isLastAction() const { return mIsLast; }

    /// Where tables and lists go: stdout, unless that carries data.
    std::ostream& textOut() const;
    /// Puts @a text there, or to another stream. A reader that has seen enough (`| head`) is no
    /// error.
    /// @throw CommandError (output)
    void print(const std::string& text) { print(text, textOut()); }
    void print(const std::string& text, std::ostream& out);
    /// A line on stderr, where -verbose or -debug has been given.
    void remark(const std::string& line);
    /// A line on stderr, unless -quiet has been given.
    void note(const std::string& line);
    /// The same, of what may be wrong.
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
    void reportTime(const std::string& what, double seconds);

    bool mReaderIsGone = false, mIsLast = false;
};

/// @brief Look at everything that can be checked before any work.
/// @throw CommandError
Plan checkLine(const std::vector<ActionCall>& line);

} // namespace command
