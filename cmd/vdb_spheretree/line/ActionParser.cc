// SPDX-License-Identifier: Apache-2.0
#include "ActionParser.h"

#include "ConfigFile.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

namespace command {

namespace {

/// Number of characters to insert, delete or replace to turn one word into the other (Levenshtein,
/// one row of the table at a time).
size_t editDistance(const std::string& a, const std::string& b)
{
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t(0));
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

bool startsWith(const std::string& text, const std::string& prefix)
{
    return text.compare(0, prefix.size(), prefix) == 0;
}

std::string joined(const std::vector<std::string>& words)
{
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
    return all;
}

const ActionSpec& actionOfToken(const std::string& token)
{
    const size_t start = token.find_first_not_of('-');
    if (start == std::string::npos) {
        throwUsage("'" + token + "' names no action (try -help)");
    }
    const std::string name = token.substr(start);
    if (const ActionSpec* action = findAction(name)) return *action;
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
        if (!startsWith(option.name, prefix)) continue;
        matches.push_back(option.name);
        match = &option;
    }
    if (matches.size() > 1) {
        throwUsage(where + "option " + prefix + " is ambiguous: it could be " + joined(matches));
    }
    if (match) return *match;
    throwUsage(where + "unknown option " + prefix + didYouMean(prefix, names) + "; try -help "
        + action.name);
}

void addOption(ActionCall& call, const std::string& token, size_t equals)
{
    const OptionSpec& option = optionOfPrefix(call.spec(), token.substr(0, equals));
    const std::string value = token.substr(equals + 1);
    if (call.given(option.name)) {
        throwUsage(call.label() + ": option " + option.name + " is given more than once");
    }
    checkValue(call.spec(), option, value);
    if (option.kind == OptionKind::List) call.appendToList(option.name, value);
    else call.set(option.name, value);
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
    checkValue(spec, option, token);
    if (option.kind == OptionKind::List) {
        call.appendToList(option.name, token);
        return;
    }
    if (call.given(option.name)) {
        throwUsage(
            call.label() + ": '" + token + "' gives option " + option.name + " more than once");
    }
    call.set(option.name, token);
}

/// Checks the order of the actions.
void checkOrder(const std::vector<ActionCall>& calls)
{
    bool anythingThere = false;
    std::vector<const ActionSpec*> seen;
    for (const ActionCall& call : calls) {
        const ActionSpec* const spec = &call.spec();
        if (spec->once && std::find(seen.begin(), seen.end(), spec) != seen.end()) {
            throwUsage(call.label() + " is given more than once");
        }
        seen.push_back(spec);
        if (spec->isSource) anythingThere = true;
        if (spec->needsInput && !anythingThere) {
            const bool afterHelp = seen.size() > 1 && seen[seen.size() - 2]->name == "help";
            throwUsage(call.label() + " has nothing to work on: put -read before it"
                + (afterHelp ? "; for its help: -help " + spec->name : ""));
        }
    }
}

/// A file name may hold an equals sign.
bool isFileNotOption(const ActionSpec& action, const std::string& token, size_t equals)
{
    const std::string prefix = token.substr(0, equals);
    for (const OptionSpec& option : action.options) {
        if (startsWith(option.name, prefix)) return false;
    }
    std::error_code ignored;
    return std::filesystem::exists(token, ignored);
}

std::vector<ActionCall> callsOf(const std::vector<std::string>& tokens)
{
    std::vector<ActionCall> calls;
    for (const std::string& token : tokens) {
        if (!token.empty() && token.front() == '-') {
            calls.emplace_back(actionOfToken(token));
            continue;
        }
        if (calls.empty()) {
            throwUsage("'" + token + "' stands before any action; to read a file: -read " + token);
        }
        const size_t equals = token.find('=');
        if (equals == std::string::npos || isFileNotOption(calls.back().spec(), token, equals)) {
            addMain(calls.back(), token);
        } else {
            addOption(calls.back(), token, equals);
        }
    }
    return calls;
}

/// Puts the actions of its files in the place of each -config. @a depth: a file may name itself.
std::vector<ActionCall> withConfigFiles(
    const std::vector<ActionCall>& calls, int depth, size_t& bytesInAll)
{
    constexpr int kDeepest = 8;
    std::vector<ActionCall> expanded;
    for (const ActionCall& call : calls) {
        if (call.spec().name != "config") {
            expanded.push_back(call);
            continue;
        }
        if (!call.given("files")) throwUsage("-config: names no file");
        if (depth == kDeepest) throwUsage("-config: files name each other more than 8 deep");
        for (const std::string& path : call.list("files")) {
            try {
                const auto read = callsOf(readConfigFile(path, bytesInAll));
                const auto inner = withConfigFiles(read, depth + 1, bytesInAll);
                expanded.insert(expanded.end(), inner.begin(), inner.end());
            } catch (...) {
                rethrowNamed("-config " + path, kInput);
            }
        }
    }
    return expanded;
}

} // namespace

std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates)
{
    std::vector<std::string> near;
    const size_t enough = std::max<size_t>(1, word.size() / 3);
    for (const std::string& candidate : candidates) {
        const bool continues = word.size() > 2 && startsWith(candidate, word);
        if (continues || editDistance(word, candidate) <= enough) near.push_back(candidate);
    }
    return near.empty() ? "" : " (did you mean " + joined(near) + "?)";
}

std::vector<ActionCall> parseLine(const std::vector<std::string>& tokens)
{
    size_t bytesInConfigFiles = 0;
    const auto calls = withConfigFiles(callsOf(tokens), 0, bytesInConfigFiles);
    checkOrder(calls);
    return calls;
}

} // namespace command
