// SPDX-License-Identifier: Apache-2.0
#include "Action.h"

#include "expression/Expression.h"
#include "expression/FrameName.h"
#include "Length.h"
#include "base/DidYouMean.h"

#include <openvdb_spheretree/base/Text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace command {

using openvdb_spheretree::detail::lowerCase;
using openvdb_spheretree::detail::parseNumber;

namespace {

std::optional<bool> parseFlag(const std::string& value)
{
    for (const char* yes : {"1", "true", "yes", "on"}) {
        if (value == yes) return true;
    }
    for (const char* no : {"0", "false", "no", "off"}) {
        if (value == no) return false;
    }
    return {};
}

std::string numberText(double number)
{
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof(buffer), number).ptr;
    return std::string(buffer, end);
}

/// @return a length as it was typed, in metres where it has a unit.
std::optional<double> lengthOf(const std::string& typed)
{
    if (const auto length = parseLength(typed)) return length->metres;
    return parseNumber<double>(typed);
}

std::string rangeText(const OptionSpec& option)
{
    if (std::isinf(option.highest)) return numberText(option.lowest) + " or more";
    return numberText(option.lowest) + " to " + numberText(option.highest);
}

std::string allowedText(const OptionSpec& option)
{
    const bool bounded = !std::isinf(option.lowest) || !std::isinf(option.highest);
    switch (option.kind) {
    case OptionKind::Flag: return "1 or 0";
    case OptionKind::Integer: return "a whole number" + (bounded ? ", " + rangeText(option) : "");
    case OptionKind::Real: return "a number" + (bounded ? ", " + rangeText(option) : "");
    case OptionKind::Length: return "a length, such as 5 or 5mm, " + rangeText(option);
    case OptionKind::Vector: return "three numbers, a comma between";
    default: break;
    }
    std::string allowed;
    for (const std::string& c : option.choices) allowed += (allowed.empty() ? "" : ", ") + c;
    return allowed;
}

bool isAllowed(const OptionSpec& option, const std::string& value)
{
    const auto inRange = [&](double number) {
        return std::isfinite(number) && number >= option.lowest && number <= option.highest;
    };
    switch (option.kind) {
    case OptionKind::Flag: return parseFlag(value).has_value();
    case OptionKind::Integer: {
        const auto number = parseNumber<int64_t>(value);
        return number && inRange(double(*number));
    }
    case OptionKind::Real: {
        const auto number = parseNumber<double>(value);
        return number && inRange(*number);
    }
    case OptionKind::Length: {
        const auto number = lengthOf(value);
        return number && inRange(*number);
    }
    case OptionKind::Vector: return parseVector(value).has_value();
    case OptionKind::Choice: return option.hasChoice(value);
    default: return true;
    }
}

} // namespace

OptionSpec text(const std::string& name, const std::string& fallback, const std::string& doc)
{
    return {name, OptionKind::Text, fallback, doc};
}

OptionSpec list(const std::string& name, const std::string& fallback, const std::string& doc)
{
    return {name, OptionKind::List, fallback, doc};
}

OptionSpec words(const std::string& name, const std::string& doc)
{
    return {name, OptionKind::Words, "", doc};
}

OptionSpec flag(const std::string& name, bool fallback, const std::string& doc)
{
    return {name, OptionKind::Flag, fallback ? "1" : "0", doc};
}

OptionSpec integer(const std::string& name, const std::string& fallback, int64_t lowest,
    int64_t highest, const std::string& doc)
{
    return {name, OptionKind::Integer, fallback, doc, double(lowest), double(highest)};
}

OptionSpec real(const std::string& name, const std::string& fallback, double lowest, double highest,
    const std::string& doc)
{
    return {name, OptionKind::Real, fallback, doc, lowest, highest};
}

OptionSpec length(const std::string& name, const std::string& fallback, double lowest,
    double highest, const std::string& doc)
{
    return {name, OptionKind::Length, fallback, doc, lowest, highest};
}

OptionSpec vector(const std::string& name, const std::string& fallback, const std::string& doc)
{
    return {name, OptionKind::Vector, fallback, doc};
}

OptionSpec choice(
    const std::string& name, const std::vector<std::string>& choices, const std::string& doc)
{
    OptionSpec option{name, OptionKind::Choice, choices.front(), doc};
    option.choices = choices;
    return option;
}

OptionSpec vdbOption(const std::string& what)
{
    return text("vdb", "",
        what
            + ", by its age on the stack (0 is the newest), its name or that of its file; "
              "by default the only one of the newest action that suits");
}

OptionSpec keepOption() { return flag("keep", false, "leave the input on the stack"); }

OptionSpec nameOption(const std::string& fallback, const std::string& doc)
{
    return text("name", fallback, doc);
}

bool OptionSpec::isMeantBy(const std::string& prefix) const
{
    const size_t least = name == "name" || name == "frames" ? 2 : 1;
    return prefix.size() >= least && name.compare(0, prefix.size(), prefix) == 0;
}

ActionSpec smallAction(const std::string& name, const std::string& doc)
{
    ActionSpec action{name, "", "", doc};
    action.quiet = true;
    action.needsInput = false;
    return action;
}

const OptionSpec* ActionSpec::option(const std::string& optionName) const
{
    for (const OptionSpec& option : options) {
        if (option.name == optionName) return &option;
    }
    return nullptr;
}

std::string ActionCall::typed() const
{
    std::string line = label();
    for (const OptionSpec& option : mSpec->options) {
        if (!given(option.name)) continue;
        const bool isMain = option.name == mSpec->mainOption || mSpec->anyName;
        line += " " + (isMain ? "" : option.name + "=") + text(option.name);
    }
    return oneLine(line, 120);
}

bool isOpen(const ActionSpec& action, const OptionSpec& option, const std::string& typed)
{
    const bool isName = option.kind == OptionKind::Text || option.kind == OptionKind::List;
    if (action.isLiteral || !(hasExpression(typed) || (isName && hasFrame(typed)))) return false;
    std::error_code ignored;
    return !isName || !std::filesystem::exists(typed, ignored);
}

void ActionCall::give(const OptionSpec& option, const std::string& typed)
{
    const bool open = command::isOpen(*mSpec, option, typed);
    mGiven.push_back({&option, typed, open});
    if (open) {
        mIsOpen = true;
        mValues[option.name].push_back(typed);
        return;
    }
    try {
        setValue(option, typed);
    } catch (...) {
        rethrowNamed(label(), kUsage);
    }
}

ActionCall ActionCall::evaluated(const Evaluate& evaluate) const
{
    ActionCall call(*mSpec);
    call.mOrigin = mOrigin;
    for (const Given& one : mGiven) {
        call.setValue(*one.option, one.isOpen ? evaluate(*one.option, one.typed) : one.typed);
    }
    return call;
}

/// Splits that of a list at its commas, unless it names a file that exists.
void ActionCall::setValue(const OptionSpec& option, const std::string& value)
{
    checkValue(option, value);
    std::vector<std::string>& items = mValues[option.name];
    std::error_code ignored;
    const bool isOne = option.kind != OptionKind::List || std::filesystem::exists(value, ignored);
    if (isOne) {
        items.push_back(value);
        return;
    }
    for (size_t begin = 0; begin < value.size();) {
        const size_t end = std::min(value.find(',', begin), value.size());
        items.push_back(value.substr(begin, end - begin));
        begin = end + 1;
    }
}

std::string ActionCall::text(const std::string& option) const
{
    const auto found = mValues.find(option);
    if (found == mValues.end()) return mSpec->option(option)->fallback;
    std::string all;
    for (const std::string& item : found->second) all += (all.empty() ? "" : ",") + item;
    return all;
}

std::vector<std::string> ActionCall::list(const std::string& option) const
{
    const auto found = mValues.find(option);
    if (found != mValues.end()) return found->second;
    const std::string& fallback = mSpec->option(option)->fallback; // a single item, or none
    return fallback.empty() ? std::vector<std::string>() : std::vector<std::string>{fallback};
}

bool ActionCall::flag(const std::string& option) const { return *parseFlag(text(option)); }

int64_t ActionCall::integer(const std::string& option) const
{
    return *parseNumber<int64_t>(text(option));
}

double ActionCall::real(const std::string& option) const
{
    return *parseNumber<double>(text(option));
}

double ActionCall::length(const std::string& option) const { return *lengthOf(text(option)); }

std::array<double, 3> ActionCall::vector(const std::string& option) const
{
    return *parseVector(text(option));
}

std::optional<std::array<double, 3>> parseVector(const std::string& typed)
{
    if (typed == "x") return std::array<double, 3>{1, 0, 0};
    if (typed == "y") return std::array<double, 3>{0, 1, 0};
    if (typed == "z") return std::array<double, 3>{0, 0, 1};
    const bool enclosed = typed.size() > 1 && typed.front() == '(' && typed.back() == ')';
    const std::string text = enclosed ? typed.substr(1, typed.size() - 2) : typed;
    std::array<double, 3> numbers;
    size_t begin = 0;
    for (size_t i = 0; i < numbers.size(); ++i) {
        const bool last = i + 1 == numbers.size();
        const size_t end = last ? text.size() : text.find(',', begin);
        if (end == std::string::npos) return {};
        const auto number = parseNumber<double>(text.substr(begin, end - begin));
        if (!number || !std::isfinite(*number)) return {};
        numbers[i] = *number;
        begin = end + 1;
    }
    return numbers;
}

void checkValue(const OptionSpec& option, const std::string& value)
{
    if (option.kind == OptionKind::Words) return;
    if (value.empty()) throwUsage("option " + option.name + " has no value");
    const bool emptyItem =
        value.front() == ',' || value.back() == ',' || value.find(",,") != std::string::npos;
    if (option.kind == OptionKind::List && emptyItem) {
        throwUsage("an item of " + option.name + "=" + value + " is empty");
    }
    if (option.kind == OptionKind::Choice && !isAllowed(option, value)) {
        throwUsage(option.name + "=" + value + " is unknown: it takes " + allowedText(option)
            + didYouMean(lowerCase(value), option.choices));
    }
    if (!isAllowed(option, value)) {
        const std::string number = value.substr(0, value.size() - 1);
        if (option.isPercent && value.back() == '%' && isAllowed(option, number)) {
            throwUsage(option.name + "=" + value + ": it is in percent as it is (did you mean "
                + option.name + "=" + number + "?)");
        }
        throwUsage(option.name + "=" + value + " is out of range or not understood: " + "it takes "
            + allowedText(option));
    }
}

} // namespace command
