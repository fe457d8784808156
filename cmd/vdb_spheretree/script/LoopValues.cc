// SPDX-License-Identifier: Apache-2.0
#include "LoopValues.h"

#include "base/Errors.h"
#include "expression/Number.h"

#include <openvdb_spheretree/base/Text.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

namespace command {

namespace {

using openvdb_spheretree::detail::inQuotes;

constexpr double kLargest = 1e15; ///< of the numbers of a range

std::vector<std::string> splitAtCommas(const std::string& text)
{
    std::vector<std::string> parts;
    for (size_t begin = 0; begin <= text.size();) {
        const size_t end = std::min(text.find(',', begin), text.size());
        parts.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

void requireVariable(const std::string& name)
{
    const auto isLetter = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    };
    const auto isFit = [&](char c) { return isLetter(c) || (c >= '0' && c <= '9'); };
    if (name.empty() || !isLetter(name[0]) || !std::all_of(name.begin(), name.end(), isFit)) {
        throwUsage(inQuotes(name)
            + " is no name of a variable: it takes letters, digits and _, and no digit first");
    }
}

/// @return the words of `NAME=a,b c`, split at the '='.
LoopValues namedWords(const ActionCall& call, const std::string& example)
{
    const std::vector<std::string> words = call.list(call.spec().options.front().name);
    const size_t equals = words.empty() ? std::string::npos : words[0].find('=');
    if (equals == std::string::npos) throwUsage("names no variable: " + example);
    LoopValues loop{words[0].substr(0, equals), {}};
    requireVariable(loop.variable);
    const std::string first = words[0].substr(equals + 1);
    if (!first.empty()) loop.values = splitAtCommas(first);
    for (size_t i = 1; i < words.size(); ++i) {
        for (const std::string& value : splitAtCommas(words[i])) loop.values.push_back(value);
    }
    return loop;
}

void requireFew(double turns)
{
    if (turns <= double(kMostSteps)) return;
    throwUsage("has more than " + std::to_string(kMostSteps) + " turns");
}

std::vector<std::string> wholeRange(int64_t begin, int64_t end, int64_t step)
{
    requireFew((double(end) - double(begin)) / double(step));
    std::vector<std::string> values;
    for (int64_t i = begin; step > 0 ? i < end : i > end; i += step) {
        values.push_back(std::to_string(i));
    }
    return values;
}

/// Each value from its number, so that rounding does not add up: 0,1,0.1 has ten.
std::vector<std::string> realRange(double begin, double end, double step)
{
    constexpr double kRounding = 1e-9; // of a step
    const double turns = std::ceil((end - begin) / step - kRounding);
    requireFew(turns);
    std::vector<std::string> values;
    for (double i = 0; i < turns; ++i) values.push_back(textOfReal(begin + i * step));
    return values;
}

/// @return two or three numbers, or nothing if one of the texts is none.
template <typename Real>
std::vector<Real> numbersOf(const std::vector<std::string>& texts)
{
    std::vector<Real> numbers;
    for (const std::string& text : texts) {
        const auto number = openvdb_spheretree::detail::parseNumber<Real>(text);
        if (!number || !(std::abs(double(*number)) <= kLargest)) return {};
        numbers.push_back(*number);
    }
    if (numbers.size() == 2) numbers.push_back(1);
    return numbers;
}

LoopValues forValues(const ActionCall& call)
{
    LoopValues loop = namedWords(call, "-for i=0,10 (10 is not one of them)");
    const std::string typed = oneLine(call.list(call.spec().options.front().name).front(), 60);
    const size_t count = loop.values.size();
    if (count != 2 && count != 3) {
        throwUsage(typed + " has " + std::to_string(count) + (count == 1 ? " number" : " numbers")
            + ", and takes two or three: -for i=0,10 or -for i=0,10,2");
    }
    const auto whole = numbersOf<int64_t>(loop.values);
    const auto real = numbersOf<double>(loop.values);
    if (real.empty()) throwUsage(typed + " has what is no number, or too large a one");
    if (real[2] == 0) throwUsage(typed + " has a step of 0, and no end");
    loop.values = whole.empty() ? realRange(real[0], real[1], real[2])
                                : wholeRange(whole[0], whole[1], whole[2]);
    return loop;
}

LoopValues eachValues(const ActionCall& call)
{
    LoopValues loop = namedWords(call, "-each s=bunny,dragon");
    for (const std::string& value : loop.values) {
        if (value.empty()) throwUsage("a value of " + loop.variable + " is empty");
    }
    return loop;
}

bool isWanted(const std::filesystem::path& path, const ActionCall& call)
{
    const std::string name = path.filename().string();
    const std::string extension = openvdb_spheretree::detail::lowerExtension(name);
    const auto any = [&](const std::string& option, const auto& holds) {
        const std::vector<std::string> list = call.list(option);
        return std::any_of(list.begin(), list.end(), holds);
    };
    const auto isPart = [&](const std::string& part) { return name.find(part) != name.npos; };
    const auto isExtension = [&](const std::string& wanted) {
        const std::string lower = openvdb_spheretree::detail::lowerCase(wanted);
        return extension == lower || extension == "." + lower;
    };
    if (name[0] == '.') return false; // also what is being written
    if (call.given("extension") && !any("extension", isExtension)) return false;
    if (call.given("include") && !any("include", isPart)) return false;
    return !any("exclude", isPart);
}

template <typename Iterator>
void addFiles(const std::string& folder, const ActionCall& call, std::vector<std::string>& files)
{
    std::error_code error;
    Iterator entry(folder, error);
    for (; !error && entry != Iterator(); entry.increment(error)) {
        std::error_code ignored;
        if (!entry->is_regular_file(ignored) || !isWanted(entry->path(), call)) continue;
        files.push_back(entry->path().string());
        requireFew(double(files.size()));
    }
    if (error) throwInput("cannot read the folder " + folder + ": " + error.message());
}

LoopValues fileValues(const ActionCall& call)
{
    namespace fs = std::filesystem;
    if (!call.given("path")) throwUsage("names no folder");
    LoopValues loop{"file", {}};
    for (const std::string& folder : call.list("path")) {
        if (call.flag("recursive"))
            addFiles<fs::recursive_directory_iterator>(folder, call, loop.values);
        else addFiles<fs::directory_iterator>(folder, call, loop.values);
    }
    std::sort(loop.values.begin(), loop.values.end());
    return loop;
}

} // namespace

LoopValues loopValues(const ActionCall& call)
{
    switch (call.spec().block) {
    case Block::For: return forValues(call);
    case Block::Each: return eachValues(call);
    default: return fileValues(call);
    }
}

} // namespace command
