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
    ActionSpec action{name, "", "", doc};
    action.once = action.quiet = true;
    action.needsInput = false;
    action.run = [verbosity](const ActionCall&, Session& session) {
        session.verbosity = verbosity;
        session.progress.setEnabled(verbosity != Verbosity::Quiet);
    };
    return action;
}

void checkThreads(const ActionCall& call, Plan&)
{
    if (!call.given("threads")) throwUsage("a number of threads is missing");
}

void runThreads(const ActionCall& call, Session& session)
{
    session.threads = std::make_unique<tbb::global_control>(
        tbb::global_control::max_allowed_parallelism, size_t(call.integer("threads")));
}

} // namespace

ActionSpec quietAction()
{
    return modeAction("quiet", Verbosity::Quiet, "print nothing but results and errors");
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
    ActionSpec action{"threads", "", "threads",
        "use this many threads (by default one for each core); results do not depend on it"};
    action.options = {integer("threads", "", 1, 1024, "number of threads")};
    action.once = action.quiet = true;
    action.needsInput = false;
    action.check = checkThreads;
    action.run = runThreads;
    return action;
}

ActionSpec clearAction()
{
    ActionSpec action{"clear", "", "", "remove everything from the stack"};
    action.quiet = true;
    action.needsInput = false;
    action.run = [](const ActionCall&, Session& session) { session.stack.clear(); };
    return action;
}

} // namespace command
