// SPDX-License-Identifier: Apache-2.0
/// @file ModeActions.cc
/// @brief The small actions: -threads, -quiet, -verbose, -debug, -clear. Each holds for the actions
/// after it.

#include "line/Actions.h"
#include "session/Session.h"

namespace command {

namespace {

ActionSpec modeAction(const std::string& name, Verbosity verbosity, const std::string& doc)
{
    ActionSpec action = smallAction(name, doc);
    action.once = true;
    action.run = [verbosity](const ActionCall&, Session& session) {
        session.verbosity = verbosity;
        session.progress.setEnabled(verbosity != Verbosity::Quiet);
    };
    return action;
}

} // namespace

ActionSpec quietAction()
{
    return modeAction("quiet", Verbosity::Quiet, "print nothing but results, warnings and errors");
}

ActionSpec verboseAction()
{
    return modeAction("verbose", Verbosity::Verbose, "print more about each action");
}

ActionSpec debugAction()
{
    return modeAction("debug", Verbosity::Debug, "print all there is to say about each action");
}

ActionSpec threadsAction()
{
    ActionSpec action = smallAction("threads",
        "use this many threads (by default one for each core); results do not depend on it");
    action.mainOption = "threads";
    action.options = {integer("threads", "", 1, 1024, "number of threads")};
    action.once = true;
    action.check = [](const ActionCall& call, Plan&) {
        if (!call.given("threads")) throwUsage("a number of threads is missing");
    };
    action.run = [](const ActionCall& call, Session& session) {
        session.limitThreads(size_t(call.integer("threads")));
    };
    return action;
}

ActionSpec clearAction()
{
    ActionSpec action = smallAction("clear", "remove everything from the stack");
    action.run = [](const ActionCall&, Session& session) { session.stack.clear(); };
    return action;
}

} // namespace command
