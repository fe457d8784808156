// SPDX-License-Identifier: Apache-2.0
/// @file ScriptRunner.h
/// @brief Runs a script, frame by frame.
///
/// A frame that fails for reasons of its own (its input, or a -check) does not keep the others from being
/// done; they are named when the loop is through, and nothing after the loop is done: it would lack
/// something. What cannot be written, or is wrong in the line itself, ends the loop at once, for the
/// next frame would fail as well.

#pragma once

#include "script/Script.h"
#include "Session.h"
#include "StackInfo.h"

#include <set>
#include <string>
#include <vector>

namespace command {

class ScriptRunner {
public:
    explicit ScriptRunner(Session& session) : mSession(session), mFacts(session.stack) {}

    /// @throw CommandError, Interrupted
    void run(const std::vector<Step>& steps);

private:
    struct Turns;

    /// @param isEnd  whether nothing will need the stack afterwards
    void runSteps(const std::vector<Step>& steps, bool isEnd);
    void runStep(const Step& step, bool isEnd);
    void runAction(const Step& step);
    void runIf(const Step& step, bool isEnd);
    void runLoop(const Step& loop, bool isEnd);
    void runFrame(const Frame& frame, Turns& turns, bool isEnd);
    /// @return whether the rest of the steps is done without an object.
    bool goOnEmpty(const std::vector<Step>& steps, const Step& failed, const EmptyError& error);
    void replay(const std::vector<Assignment>& assignments);
    ActionCall closed(const Step& step);

    Session& mSession;
    StackInfo mFacts;
    Variables mVariables;
    std::set<size_t> mNoted; ///< places of actions whose result is lost
};

} // namespace command
