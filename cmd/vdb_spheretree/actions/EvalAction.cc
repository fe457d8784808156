// SPDX-License-Identifier: Apache-2.0
/// @file EvalAction.cc
/// @brief -eval: values of expressions, and the list of their functions.

#include "base/DidYouMean.h"
#include "expression/Functions.h"
#include "Help.h"
#include "line/Actions.h"
#include "session/Session.h"

#include <openvdb_spheretree/base/TextStream.h>

namespace command {

namespace {

void check(const ActionCall& call, Plan&)
{
    if (!call.given("str") && !call.given("help")) throwUsage("has nothing to evaluate");
    std::vector<std::string> names;
    for (const Function& function : allFunctions()) names.push_back(function.name);
    for (const std::string& name : call.list("help")) {
        if (name == "*" || findFunction(name)) continue;
        throwUsage("there is no function " + oneLine(name, 60) + didYouMean(name, names));
    }
}

void run(const ActionCall& call, Session& session)
{
    openvdb_spheretree::detail::TextStream out;
    for (const std::string& name : call.list("help")) {
        for (const Function& function : allFunctions()) {
            if (name == "*" || name == function.name) printEntry(out, function.name, function.doc);
        }
    }
    for (const std::string& text : call.list("str")) {
        if (!text.empty()) out << text << "\n";
    }
    session.print(out.str());
}

} // namespace

ActionSpec evalAction()
{
    ActionSpec action = smallAction("eval", "print texts with the values of their expressions");
    action.mainOption = "str";
    action.options = {
        words("str", "texts such as '{1:2:+}'; an expression may also store a variable, '{3:@n}'"),
        list("help", "", "list these functions of expressions, or all of them (*)")};
    action.check = check;
    action.run = run;
    return action;
}

} // namespace command
