// SPDX-License-Identifier: Apache-2.0
#include "Session.h"

#include "base/Errors.h"
#include "base/LastWords.h"
#include "base/Terminal.h"
#include "ScriptRunner.h"

#include <openvdb_spheretree/base/Text.h>

#include <tbb/global_control.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <iostream>
#include <memory>
#include <utility>

namespace command {

void Session::run(const Script& script)
{
    ScriptRunner(*this).run(script.steps);
    noteAllIsDone();
}

Session::InFrame::InFrame(Session& session, const std::string& name, const std::string& label)
    : mSession(session), mName(session.plan.frame()), mLabel(std::exchange(session.mFrame, label))
{
    session.plan.setFrame(name);
    session.seconds = {};
    session.total = {};
}

Session::InFrame::~InFrame()
{
    mSession.plan.setFrame(mName);
    mSession.mFrame = mLabel;
}

Session::InLoop::InLoop(Session& session, bool isSequence)
    : mSession(session), mOuter(std::exchange(session.mVoxels, isSequence ? &mVoxels : nullptr))
{}

Session::InLoop::~InLoop() { mSession.mVoxels = mOuter; }

void Session::requireVoxelsOfSequence(double size) const
{
    if (!mVoxels) return;
    const auto first = mVoxels->find(mPlace);
    if (first == mVoxels->end() || areSameVoxels(size, first->second)) return;
    throwInput(otherVoxelsText(size, first->second) + "; samevoxels=0 allows it");
}

void Session::noteVoxelsOfSequence(double size)
{
    if (mVoxels) mVoxels->emplace(mPlace, size);
}

bool Session::areSameVoxels(double size, double other)
{
    constexpr double kSame = 1e-5;
    return std::abs(size - other) <= kSame * other;
}

std::string Session::otherVoxelsText(double size, double before)
{
    using openvdb_spheretree::detail::shortNumber;
    const std::string wanted = " voxel=" + shortNumber(before);
    return "voxels are of " + shortNumber(size) + ", and in the frames before of "
        + shortNumber(before) + ": -mesh2ls" + wanted + " (meshes) or -resample" + wanted
        + " (volumes) makes them the same";
}

void Session::runOne(const ActionCall& call)
{
    const Stopwatch watch;
    const bool silent = call.spec().quiet || verbosity == Verbosity::Quiet;
    const std::string typed = inFrame(call.typed());
    const auto finish = [&](bool complete) {
        if (!silent) progress.endAction(complete);
    };
    if (!silent) {
        progress.beginAction(typed, call.spec().work ? call.spec().work(call) : LongWork());
    }
    try {
        call.spec().run(call, *this);
        requireUnchangedInputs();
    } catch (...) {
        finish(false);
        rethrowNamed(call.where(), call.spec().failure);
    }
    finish(true);
    if (silent || (!mFrame.empty() && verbosity < Verbosity::Verbose)) return; // a line a frame
    std::cerr << typed << " ... completed in " << prettySeconds(watch.seconds()) << std::endl;
}

void Session::noteIfUnverified(const StackItem& item)
{
    if (!item.unverified) return;
    note(item.description()
        + " has no checksum, as those of version 0.1: nobody can tell whether it is whole");
}

void Session::warnIfReplaced(const std::string& path)
{
    if (!plan.replacesInput(path)) return;
    warn(path + ", which was read, is replaced by what is written");
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

void Session::tellInterrupted(const std::string& frame, const std::string& done)
{
    if (std::exchange(mToldInterrupted, true)) return;
    say(Verbosity::Quiet, "vdb_spheretree: ", frame + " is interrupted, and " + done);
}

void Session::warn(const std::string& line)
{
    say(Verbosity::Quiet, "vdb_spheretree: " + coloured(std::cerr, Colour::Yellow, "warning: "),
        inFrame(line));
}

void Session::say(Verbosity least, const std::string& start, const std::string& line)
{
    if (verbosity < least) return;
    progress.clearLine();
    std::cerr << start << oneLine(line) << std::endl;
}

} // namespace command
