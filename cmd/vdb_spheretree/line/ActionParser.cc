// SPDX-License-Identifier: Apache-2.0
#include "ActionParser.h"

#include "base/DidYouMean.h"
#include "ConfigFile.h"
#include "Defaults.h"

#include <algorithm>
#include <filesystem>

namespace command {

namespace {

std::string joined(const std::vector<std::string>& words)
{
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
    return all;
}

/// @return what to type in place of `-spheres 64`, `-spheres=64` and `-read=a.vdb`; empty if @a name
/// is neither an option nor an action.
std::string dashHint(const std::string& name, const std::string& value)
{
    if (findAction(name)) return "a blank, and no '=', goes after it: -" + name + " " + value;
    std::vector<std::string> actions;
    for (const ActionSpec& action : actionTable()) {
        if (action.option(name)) actions.push_back("-" + action.name);
    }
    if (actions.empty()) return "";
    const auto build = std::find(actions.begin(), actions.end(), "-spheretree");
    const std::string& likely = build == actions.end() ? actions.front() : *build;
    return name + " is an option of " + joined(actions) + ", and options have no dash: " + likely
        + " " + name + "=" + (value.empty() ? "..." : value);
}

/// @param next  the token after it, or empty
const ActionSpec& actionOfToken(const std::string& token, const std::string& next)
{
    const size_t start = token.find_first_not_of('-');
    if (start == std::string::npos) {
        throwUsage("'" + token + "' names no action (try -help)");
    }
    const std::string name = token.substr(start);
    if (const ActionSpec* action = findAction(name)) return *action;
    const size_t equals = name.find('=');
    const bool nextIsValue = equals == std::string::npos && next.substr(0, 1) != "-";
    const std::string value = equals != std::string::npos ? name.substr(equals + 1)
        : nextIsValue                                     ? next
                                                          : "";
    const std::string hint = dashHint(name.substr(0, equals), value);
    if (!hint.empty()) throwUsage("unknown action " + token + ": " + hint);
    std::vector<std::string> names;
    for (const ActionSpec& action : actionTable()) names.push_back("-" + action.name);
    throwUsage("unknown action " + token + didYouMean("-" + name, names) + "; try -help");
}

const OptionSpec& optionOfPrefix(const ActionSpec& action, const std::string& prefix)
{
    const std::string where = "-" + action.name + ": ";
    if (prefix.empty()) throwUsage(where + "an option name is missing before '='");
    if (const OptionSpec* exact = action.option(prefix)) return *exact;
    std::vector<std::string> names, matches;
    const OptionSpec* match = nullptr;
    for (const OptionSpec& option : action.options) {
        names.push_back(option.name);
        if (!option.isMeantBy(prefix)) continue;
        matches.push_back(option.name);
        match = &option;
    }
    if (matches.size() > 1) {
        throwUsage(where + "option " + prefix + " is ambiguous: it could be " + joined(matches));
    }
    if (match) return *match;
    const bool isCount =
        prefix == "n" || prefix == "num" || prefix == "number" || prefix == "count";
    const bool isNumber = isCount && !action.numberOption.empty();
    throwUsage(where + "unknown option " + prefix
        + (isNumber ? " (did you mean " + action.numberOption + "=?)" : didYouMean(prefix, names))
        + "; try -help " + action.name);
}

void addOption(ActionCall& call, const std::string& token, size_t equals)
{
    const OptionSpec& option = optionOfPrefix(call.spec(), token.substr(0, equals));
    const std::string value = token.substr(equals + 1);
    if (call.given(option.name)) {
        throwUsage(call.label() + ": option " + option.name + " is given more than once");
    }
    call.give(option, value);
}

/// @return the options that have a choice of this name, each with it, as they would be typed.
std::string optionsOfChoice(const ActionSpec& spec, const std::string& choice)
{
    std::string all;
    for (const OptionSpec& option : spec.options) {
        if (!option.hasChoice(choice)) continue;
        all += (all.empty() ? "" : " or ") + option.name + "=" + choice;
    }
    return all;
}

void addMain(ActionCall& call, const std::string& token)
{
    const ActionSpec& spec = call.spec();
    if (token.empty()) throwUsage(call.label() + ": an empty argument");
    if (spec.mainOption.empty()) {
        throwUsage(call.label() + " does not take '" + token + "': it has "
            + (spec.options.empty() ? "no options" : "only options of the form name=value"));
    }
    const OptionSpec& option = *spec.option(spec.mainOption);
    if (isOpen(spec, option, token) && !call.given(option.name)) return call.give(option, token);
    const bool isNumber = token.find_first_not_of("0123456789,") == std::string::npos;
    if (isNumber && option.kind == OptionKind::Choice && !spec.numberOption.empty()) {
        throwUsage(call.label() + ": '" + token + "' is no " + option.name + " (did you mean "
            + spec.numberOption + "=" + token + "?)");
    }
    if (option.kind == OptionKind::Choice && spec.option(token)) {
        throwUsage(
            call.label() + ": '" + token + "' is an option: give it a value, " + token + "=...");
    }
    if (option.kind == OptionKind::Choice && !option.hasChoice(token)) {
        const std::string meant = optionsOfChoice(spec, token);
        if (!meant.empty()) {
            throwUsage(call.label() + ": '" + token + "' is no " + option.name + " (did you mean "
                + meant + "?)");
        }
    }
    const bool takesMany = option.kind == OptionKind::List || option.kind == OptionKind::Words;
    if (!takesMany && call.given(option.name)) {
        throwUsage(
            call.label() + ": '" + token + "' gives option " + option.name + " more than once");
    }
    call.give(option, token);
}

/// Checks the order of the actions.
void checkOrder(const std::vector<ActionCall>& calls)
{
    bool anythingThere = false;
    std::vector<const ActionSpec*> seen;
    for (const ActionCall& call : calls) {
        const ActionSpec* const spec = &call.spec();
        if (spec->once && std::find(seen.begin(), seen.end(), spec) != seen.end()) {
            throwUsage(call.where() + " is given more than once");
        }
        seen.push_back(spec);
        if (spec->isSource) anythingThere = true;
        if (spec->needsInput && !anythingThere) {
            const bool afterHelp = seen.size() > 1 && seen[seen.size() - 2]->name == "help";
            throwUsage(call.where() + " has nothing to work on: put -read before it"
                + (afterHelp ? "; for its help: -help " + spec->name : ""));
        }
    }
}

/// A file name may hold an equals sign.
bool isFileNotOption(const ActionSpec& action, const std::string& token, size_t equals)
{
    const std::string prefix = token.substr(0, equals);
    for (const OptionSpec& option : action.options) {
        if (option.isMeantBy(prefix)) return false;
    }
    std::error_code ignored;
    return std::filesystem::exists(token, ignored);
}

/// @return what `help` or `version` stands for; no other action goes without its dash.
const ActionSpec& actionOfFirstWord(const std::string& word)
{
    const ActionSpec* const action = findAction(word);
    for (const char* alone : {"help", "version", "examples"}) {
        if (word == alone) return *action;
    }
    throwUsage("'" + word + "' stands before any action; "
        + (action ? "actions begin with a dash: -" + action->name
                  : "to read a file: -read " + word));
}

void addToken(ActionCall& call, const std::string& token)
{
    const ActionSpec& spec = call.spec();
    const size_t equals = token.find_first_of("={"); // an expression may hold ==
    const bool isNamed = equals != std::string::npos && token[equals] == '=';
    if (isNamed && spec.anyName) {
        call.give(spec.options.front(), token);
    } else if (!isNamed || isFileNotOption(spec, token, equals)) {
        addMain(call, token);
    } else {
        addOption(call, token, equals);
    }
}

std::vector<ActionCall> callsOf(const std::vector<std::string>& tokens)
{
    std::vector<ActionCall> calls;
    for (size_t i = 0; i < tokens.size(); ++i) {
        const std::string& token = tokens[i];
        if (!token.empty() && token.front() == '-') {
            calls.emplace_back(actionOfToken(token, i + 1 < tokens.size() ? tokens[i + 1] : ""));
            continue;
        }
        if (calls.empty()) {
            calls.emplace_back(actionOfFirstWord(token));
            continue;
        }
        addToken(calls.back(), token);
    }
    return calls;
}

/// Files of -config that are being read, each named by the one before.
struct ConfigFiles {
    std::vector<std::string> open = {};
    size_t bytesInAll = 0; ///< of these, and of those before
};

std::vector<ActionCall> withConfigFiles(const std::vector<ActionCall>& calls, ConfigFiles& files);

/// @throw CommandError (usage) if the file may not be read within those that are open
void requireEnd(const ConfigFiles& files, const std::string& path)
{
    constexpr size_t kDeepest = 8;
    const auto& open = files.open;
    if (std::find(open.begin(), open.end(), path) != open.end()) {
        throwUsage("-config " + path + ": this file comes to name itself, without end");
    }
    if (open.size() == kDeepest) throwUsage("-config: files name each other more than 8 deep");
}

/// @return the actions of a file of -config, each with the line that it stands in.
std::vector<ActionCall> callsOfFile(const std::string& path, ConfigFiles& files)
{
    requireEnd(files, path);
    files.open.push_back(path);
    std::vector<ActionCall> calls;
    for (const ConfigLine& line : readConfigFile(path, files.bytesInAll)) {
        const std::string where = "-config " + path + ", line " + std::to_string(line.number);
        try {
            std::vector<ActionCall> own = callsOf(line.words);
            for (ActionCall& call : own) call.addOrigin(where + ": ");
            const auto inner = withConfigFiles(own, files);
            calls.insert(calls.end(), inner.begin(), inner.end());
        } catch (...) {
            rethrowNamed(where, kInput);
        }
    }
    files.open.pop_back();
    return calls;
}

/// Puts the actions of its files in the place of each -config.
std::vector<ActionCall> withConfigFiles(const std::vector<ActionCall>& calls, ConfigFiles& files)
{
    std::vector<ActionCall> expanded;
    for (const ActionCall& call : calls) {
        if (call.spec().name != "config") {
            expanded.push_back(call);
            continue;
        }
        if (!call.given("files")) throwUsage("-config: names no file");
        for (const std::string& path : call.list("files")) {
            const auto inner = callsOfFile(path, files);
            expanded.insert(expanded.end(), inner.begin(), inner.end());
        }
    }
    return expanded;
}

} // namespace

std::vector<ActionCall> parseLine(const std::vector<std::string>& tokens)
{
    ConfigFiles files;
    const auto calls = withDefaults(withConfigFiles(callsOf(tokens), files));
    checkOrder(calls);
    return calls;
}

} // namespace command
