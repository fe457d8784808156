// SPDX-License-Identifier: Apache-2.0
#include "ScriptRunner.h"

#include "base/Errors.h"
#include "base/Terminal.h"
#include "script/OpenCall.h"

#include <openvdb_spheretree/base/Interrupted.h>

#include <algorithm>

namespace command {

namespace {

/// Thrown to leave a frame that has no object, where that is no error.
struct FrameSkipped {
    std::string why;
};

/// Steps that are done for a frame that has no object.
bool needsNoObject(const Step& step)
{
    const ActionSpec& spec = step.call.spec();
    return step.kind == Step::Kind::Action && (spec.writesEmpty || !spec.needsInput);
}

/// What a frame has put on the stack.
class FrameItems {
public:
    explicit FrameItems(Session& session) : mSession(session), mInputs(session.inputs.size())
    {
        for (const auto& item : session.stack.items()) mBefore.insert(item->serial);
        session.stack.beginTurn();
    }
    ~FrameItems() { mSession.stack.endTurn(); }
    FrameItems(const FrameItems&) = delete;
    FrameItems& operator=(const FrameItems&) = delete;

    std::vector<const StackItem*> items() const
    {
        std::vector<const StackItem*> own;
        for (const auto& item : mSession.stack.items()) {
            if (!mBefore.count(item->serial)) own.push_back(item.get());
        }
        return own;
    }

    /// @param all  or what has been written alone
    void drop(bool all)
    {
        for (const StackItem* item : items()) {
            if (all) mSession.stack.drop(item);
            else if (item->written) mSession.stack.giveUp(item);
        }
        auto& inputs = mSession.inputs;
        const size_t kept = std::min(mInputs, inputs.size());
        if (items().empty()) inputs.erase(inputs.begin() + std::ptrdiff_t(kept), inputs.end());
    }

private:
    Session& mSession;
    size_t mInputs;
    std::set<int64_t> mBefore; ///< serials
};

const StackItem* newestTree(const FrameItems& frame)
{
    const auto items = frame.items();
    const auto newest = std::find_if(
        items.rbegin(), items.rend(), [](const StackItem* item) { return bool(item->tree); });
    return newest == items.rend() ? nullptr : *newest;
}

std::string summaryOf(const FrameItems& frame)
{
    const StackItem* const item = newestTree(frame);
    if (!item) return "";
    const auto& levels = item->tree->levels; // they stay when -write has taken the spheres
    int64_t spheres = 0;
    for (const auto& level : levels) spheres += level.size();
    return "tree of " + counted(spheres, "sphere") + " on "
        + counted(int64_t(levels.size()), "level") + ", ";
}

/// @return what an error of a frame says, without the frame's name before it.
std::string withoutName(const std::string& why, const std::string& frame)
{
    const std::string before = frame + ": ";
    return why.rfind(before, 0) == 0 ? why.substr(before.size()) : why;
}

/// @return a part of the names of many things.
std::string someOf(const std::vector<std::string>& names, size_t most)
{
    std::string all;
    for (size_t i = 0; i < std::min(most, names.size()); ++i) all += (i ? "; " : "") + names[i];
    if (names.size() > most) all += "; and " + std::to_string(names.size() - most) + " more";
    return all;
}

} // namespace

/// The turns of one loop, and what has become of them.
struct ScriptRunner::Turns {
    const Step& loop;
    size_t begun = 0, done = 0, skipped = 0;
    std::vector<std::string> failures = {};
    ExitCode code = kOk; ///< of the first failure
    double voxel = 0;    ///< of the first tree

    std::string label() const
    {
        return loop.frames[begun - 1].name + " (" + std::to_string(begun) + " of "
            + std::to_string(loop.frames.size()) + ")";
    }

    /// Nothing of a loop that turns once.
    std::string doneOfAll() const
    {
        const size_t all = loop.frames.size();
        return all == 1 ? "" : " (of " + std::to_string(all) + " frames " + doneText() + ")";
    }

    std::string doneText() const
    {
        return std::to_string(done) + (done == 1 ? " is" : " are") + " done";
    }

    /// @throw CommandError if one has failed
    void requireAllDone() const
    {
        if (failures.empty()) return;
        constexpr size_t kNamed = 10;
        throw CommandError(code,
            std::to_string(failures.size()) + " of " + std::to_string(loop.frames.size())
                + " frames failed, " + doneText() + ": " + someOf(failures, kNamed));
    }

    /// Numbers may be those of frames. What -each and -files name are things of their own, of whatever
    /// voxels, and trees of a sequence are held to those of its first one.
    void warnOfVoxel(const StackItem* item, Session& session)
    {
        if (!item || loop.isSequence || loop.call.spec().name != "for") return;
        const double size = item->tree->voxelSize();
        if (voxel == 0) voxel = size;
        if (Session::areSameVoxels(size, voxel)) return;
        session.warn(Session::otherVoxelsText(size, voxel));
        voxel = size;
    }
};

void ScriptRunner::run(const std::vector<Step>& steps)
{
    try {
        runSteps(steps, true);
    } catch (const FrameSkipped& skipped) {
        mSession.note(skipped.why + "; nothing more is done (empty=skip)");
    }
}

void ScriptRunner::runSteps(const std::vector<Step>& steps, bool isEnd)
{
    bool isEmpty = false;
    for (const Step& step : steps) {
        throwIfStopped();
        if (isEmpty && !needsNoObject(step)) continue;
        try {
            runStep(step, isEnd && &step == &steps.back());
        } catch (const EmptyError& error) {
            if (isEmpty || !goOnEmpty(steps, step, error)) throw;
            isEmpty = true;
        }
    }
}

bool ScriptRunner::goOnEmpty(
    const std::vector<Step>& steps, const Step& failed, const EmptyError& error)
{
    if (mSession.stack.newestTreeIsEmpty() && !mSession.plan.frame().empty()) {
        mSession.note(std::string(error.what()) + "; what needs spheres is left out");
        return true;
    }
    const Step* const end = steps.data() + steps.size();
    const Step* const tree = std::find_if(&failed, end, [](const Step& step) {
        return step.kind == Step::Kind::Action && step.call.spec().runEmpty;
    });
    if (tree == end) return false;
    const ActionCall call = closed(*tree);
    if (call.text("empty") == "skip") throw FrameSkipped{error.what()};
    if (call.text("empty") != "write") return false;
    mSession.note(std::string(error.what()) + "; files without spheres are written (empty=write)");
    call.spec().runEmpty(call, mSession);
    return true;
}

void ScriptRunner::runStep(const Step& step, bool isEnd)
{
    mSession.setIsLast(isEnd);
    switch (step.kind) {
    case Step::Kind::Loop: return runLoop(step, isEnd);
    case Step::Kind::If: return runIf(step, isEnd);
    case Step::Kind::Action: return runAction(step);
    }
}

void ScriptRunner::replay(const std::vector<Assignment>& assignments)
{
    for (const auto& [name, value] : assignments) mVariables.set(name, value);
    mVariables.takeAssigned();
}

ActionCall ScriptRunner::closed(const Step& step)
{
    if (!step.call.isOpen()) return step.call;
    try {
        return closedCall(step.call, mVariables, step.number, &mFacts);
    } catch (...) {
        rethrowNamed(step.call.where(), kUsage);
    }
}

void ScriptRunner::runAction(const Step& step)
{
    if (step.isLost && mNoted.insert(step.place).second) {
        mSession.note("nothing of " + step.call.label()
            + " will be kept: no -write, -stats, -check or -print " + "comes after it");
    }
    replay(step.stored);
    const ActionCall call = closed(step);
    if (!step.isChecked) {
        checkCall(call, mSession.plan);
        mSession.plan.requireInputs();
    }
    mSession.stack.setFrame(step.number);
    mSession.setPlace(step.place);
    mSession.runOne(call);
}

void ScriptRunner::runIf(const Step& step, bool isEnd)
{
    replay(step.stored);
    if (step.call.isOpen() && !testOf(closed(step))) return;
    runSteps(step.frames.front().steps, isEnd);
}

void ScriptRunner::runLoop(const Step& loop, bool isEnd)
{
    replay(loop.stored);
    if (!loop.note.empty()) mSession.note(loop.note);
    Turns turns{loop};
    const Session::InLoop inLoop(mSession, loop.isSequence);
    mSession.stack.beginLoop();
    const std::vector<StackItem> before =
        loop.isSequence ? mSession.stack.copies() : std::vector<StackItem>();
    for (const Frame& frame : loop.frames) {
        throwIfStopped();
        ++turns.begun;
        // Each frame of a sequence finds what was there before all of them.
        if (!before.empty()) mSession.stack.restore(before);
        const bool isLast = &frame == &loop.frames.back();
        runFrame(frame, turns, isEnd && (isLast || (loop.isSequence && before.empty())));
    }
    mVariables.erase(loop.variable);
    mVariables.erase("#" + loop.variable);
    turns.requireAllDone();
}

void ScriptRunner::runFrame(const Frame& frame, Turns& turns, bool isEnd)
{
    const Stopwatch watch;
    const Session::InFrame inFrame(mSession, frame.name, turns.label());
    FrameItems items(mSession);
    const bool isLast = turns.begun == turns.loop.frames.size();
    replay(frame.variables);
    try {
        runSteps(frame.steps, isEnd);
        ++turns.done;
        turns.warnOfVoxel(newestTree(items), mSession);
        mSession.tell(turns.label() + ": " + summaryOf(items) + prettySeconds(watch.seconds()));
        if (turns.loop.isSequence || !isLast) items.drop(turns.loop.isSequence);
    } catch (const FrameSkipped& skipped) {
        ++turns.skipped;
        mSession.skippedFrames.push_back(frame.name);
        mSession.tell(turns.label() + ": skipped: " + withoutName(skipped.why, frame.name));
        items.drop(true);
    } catch (const openvdb_spheretree::Interrupted&) {
        mSession.tellInterrupted(turns.label(), turns.doneText());
        throw;
    } catch (const CommandError& error) {
        const bool isOfFrame = error.code() == kInput || error.code() == kCheckFailed;
        if (!isOfFrame || mSession.stopsAtErrors || turns.loop.frames.size() == 1) {
            throw CommandError(error.code(), error.what() + turns.doneOfAll());
        }
        if (!isLast) reportError(std::current_exception());
        if (turns.failures.empty()) turns.code = error.code();
        turns.failures.push_back(oneLine(error.what(), 200));
        items.drop(true);
    }
}

} // namespace command
