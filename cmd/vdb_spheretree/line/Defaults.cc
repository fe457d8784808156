// SPDX-License-Identifier: Apache-2.0
#include "Defaults.h"

#include "Actions.h"
#include "base/Errors.h"

#include <algorithm>

namespace command {

namespace {

struct SharedOption {
    std::string name;
    std::vector<std::string> actions; ///< empty: all that have it
    std::vector<std::string> rivals;  ///< options in whose presence it says nothing, or is refused
};

const std::vector<SharedOption>& sharedOptions()
{
    static const std::vector<SharedOption> options = {
        {"dim", {"mesh2ls"}, {"voxel"}},
        {"voxel", {"mesh2ls", "spheres2ls"}, {"dim"}},
        {"width", {"spheres2ls"}, {}},
        {"keep", {}, {}},
        {"units", {"read"}, {"scale"}},
        {"quality", {"spheretree"}, {"tree", "side"}},
        {"padding", {"spheretree"}, {"side"}},
        {"memory", {"spheretree"}, {}},
        {"empty", {"spheretree"}, {}},
        {"codec", {"write"}, {}},
    };
    return options;
}

bool isFor(const SharedOption& shared, const ActionSpec& action)
{
    const auto& names = shared.actions;
    if (!action.option(shared.name) || action.name == "default") return false;
    return names.empty() || std::count(names.begin(), names.end(), action.name) > 0;
}

/// Values by the option's name.
using Defaults = std::map<std::string, std::string>;

void addDefaults(const ActionCall& call, Defaults& defaults)
{
    if (call.given().empty()) throwUsage(call.where() + " gives no value");
    for (const auto& one : call.given()) {
        defaults[one.option->name] = one.typed;
        for (const SharedOption& shared : sharedOptions()) {
            if (shared.name != one.option->name) continue;
            for (const std::string& rival : shared.rivals) defaults.erase(rival);
        }
    }
}

void giveDefaults(const Defaults& defaults, ActionCall& call)
{
    const ActionSpec& spec = call.spec();
    const auto isGiven = [&](const std::string& name) {
        return spec.option(name) && call.given(name);
    };
    std::vector<std::pair<const OptionSpec*, std::string>> values;
    for (const SharedOption& shared : sharedOptions()) {
        const auto found = defaults.find(shared.name);
        if (found == defaults.end() || !isFor(shared, spec) || isGiven(shared.name)) continue;
        if (std::any_of(shared.rivals.begin(), shared.rivals.end(), isGiven)) continue;
        values.emplace_back(spec.option(shared.name), found->second);
    }
    for (const auto& [option, value] : values) call.give(*option, value);
}

} // namespace

std::vector<ActionCall> withDefaults(const std::vector<ActionCall>& line)
{
    Defaults defaults;
    std::vector<ActionCall> result;
    for (ActionCall call : line) {
        if (call.spec().name == "default") {
            addDefaults(call, defaults);
            continue;
        }
        giveDefaults(defaults, call);
        result.push_back(std::move(call));
    }
    return result;
}

ActionSpec defaultAction()
{
    ActionSpec action = smallAction("default",
        "values of options for all actions after it that have them and are not given others");
    action.isLiteral = true;
    const std::vector<ActionSpec> owners = {
        readAction(), mesh2lsAction(), spheretreeAction(), spheres2lsAction(), writeAction()};
    for (const SharedOption& shared : sharedOptions()) {
        std::string of;
        for (const std::string& name : shared.actions) of += (of.empty() ? "-" : " and -") + name;
        const auto owner = std::find_if(owners.begin(), owners.end(),
            [&](const ActionSpec& spec) { return isFor(shared, spec); });
        OptionSpec option = *owner->option(shared.name);
        option.fallback.clear();
        option.doc = "of " + (of.empty() ? "all actions that have it" : of);
        action.options.push_back(std::move(option));
    }
    return action;
}

} // namespace command
