// SPDX-License-Identifier: Apache-2.0
#include "OpenCall.h"

#include "base/Errors.h"
#include "expression/FrameName.h"
#include "Sequence.h"

namespace command {

namespace {

/// @throw CommandError (usage) for a length with a unit that nothing says the unit of the files to
void requireKnownUnits(const ActionCall& call, const Plan& plan)
{
    const bool hasUnits = call.spec().option("units");
    if (hasUnits && call.given("units")) return;
    for (const OptionSpec& option : call.spec().options) {
        if (option.kind != OptionKind::Length || !call.given(option.name)) continue;
        const std::string typed = call.text(option.name);
        if (hasUnits) {
            plan.requireKnownUnit(option.name, typed,
                "where it is in metres, say so by units=@ beside it: the unit of all numbers here");
        } else {
            plan.requireKnownUnit(option.name, typed);
        }
    }
}

} // namespace

ActionCall closedCall(const ActionCall& call, Variables& variables, std::optional<int64_t> number,
    const StackFacts* stack)
{
    return call.evaluated([&](const OptionSpec& option, const std::string& typed) {
        const std::string text = evaluate(typed, variables, stack);
        const bool isName = option.kind == OptionKind::Text || option.kind == OptionKind::List;
        if (!isName || !hasFrame(text)) return text;
        if (number) return withFrame(text, *number);
        if (isStack(call, text)) return text;
        throwUsage(oneLine(text, 200)
            + " has a place for a frame number, and there is none: read a sequence (-read "
              "smoke_####.vdb), or put -for i=1,26 and -end around");
    });
}

void checkCall(const ActionCall& call, Plan& plan)
{
    try {
        requireKnownUnits(call, plan);
        if (call.spec().check) call.spec().check(call, plan);
    } catch (...) {
        rethrowNamed(call.where(), kUsage);
    }
}

bool testOf(const ActionCall& call)
{
    try {
        if (!call.given("test")) throwUsage("has no test: it takes 1, 0, true or false");
        return boolOf(call.text("test"));
    } catch (...) {
        rethrowNamed(call.where(), kUsage);
    }
}

} // namespace command
