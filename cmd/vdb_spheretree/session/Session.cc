// SPDX-License-Identifier: Apache-2.0
#include "Session.h"

#include "base/LastWords.h"
#include "base/Terminal.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cerrno>
#include <iostream>
#include <memory>

namespace command {

Plan checkLine(const std::vector<ActionCall>& line)
{
    Plan plan;
    for (const ActionCall& call : line) {
        try {
            for (const OptionSpec& option : call.spec().options) {
                if (option.kind != OptionKind::Length || !call.given(option.name)) continue;
                plan.requireKnownUnit(option.name, call.text(option.name));
            }
            if (call.spec().check) call.spec().check(call, plan);
        } catch (...) {
            rethrowNamed(call.where(), kUsage);
        }
    }
    return plan;
}

namespace {

/// @param call  one of @a line
bool isGivenOut(const ActionCall& call, const std::vector<ActionCall>& line)
{
    const ActionCall* const end = line.data() + line.size();
    return std::any_of(&call, end, [](const ActionCall& later) { return later.spec().givesOut; });
}

} // namespace

void Session::run(const std::vector<ActionCall>& line)
{
    for (const ActionCall& call : line) {
        throwIfStopped();
        mIsLast = &call == &line.back();
        if (call.spec().isForLater && !isGivenOut(call, line)) {
            note("nothing of " + call.label()
                + " will be kept: no -write, -stats, -check or -print " + "comes after it");
        }
        runOne(call);
    }
    noteAllIsDone();
}

void Session::runOne(const ActionCall& call)
{
    const Stopwatch watch;
    const bool silent = call.spec().quiet || verbosity == Verbosity::Quiet;
    const auto finish = [&](bool complete) {
        if (!silent) progress.endAction(complete);
    };
    if (!silent) {
        progress.beginAction(call.typed(), call.spec().work ? call.spec().work(call) : LongWork());
    }
    try {
        call.spec().run(call, *this);
        requireUnchangedInputs();
    } catch (...) {
        finish(false);
        rethrowNamed(call.where(), call.spec().failure);
    }
    finish(true);
    if (silent) return;
    std::cerr << call.typed() << " ... completed in " << prettySeconds(watch.seconds())
              << std::endl;
}

void Session::noteIfUnverified(const StackItem& item)
{
    if (!item.unverified) return;
    note(item.description()
        + " has no checksum, as those of version 0.1: nobody can tell whether it is whole");
}

void Session::limitThreads(size_t count)
{
    // Never destroyed at the end: the limit before would be in force again, and oneTBB would start
    // threads for it, which may fail.
    static tbb::global_control* sLimit = nullptr;
    const std::unique_ptr<tbb::global_control> before(sLimit);
    sLimit = new tbb::global_control(tbb::global_control::max_allowed_parallelism, count);
}

void Session::requireUnchangedInputs() const
{
    for (const InputStamp& input : inputs) input.requireUnchanged();
}

std::ostream& Session::textOut() const
{
    return plan.stdoutIsTaken() ? std::cerr : standardOutput();
}

void Session::print(const std::string& text, std::ostream& out)
{
    if (mReaderIsGone) return;
    errno = 0;
    if (out << text << std::flush) return;
    if (errno != EPIPE) throwOutput("cannot write to " + systemError("stdout"));
    mReaderIsGone = true;
}

void Session::warn(const std::string& line)
{
    say(Verbosity::Quiet, "vdb_spheretree: " + coloured(std::cerr, Colour::Yellow, "warning: "),
        line);
}

void Session::say(Verbosity least, const std::string& start, const std::string& line)
{
    if (verbosity < least) return;
    progress.clearLine();
    std::cerr << start << oneLine(line) << std::endl;
}

} // namespace command
