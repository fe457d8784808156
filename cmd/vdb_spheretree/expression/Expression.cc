// SPDX-License-Identifier: Apache-2.0
#include "Expression.h"

#include "base/DidYouMean.h"
#include "base/Errors.h"

#include <openvdb_spheretree/base/Text.h>

#include <algorithm>

namespace command {

namespace {

using openvdb_spheretree::detail::inQuotes;

bool isBranch(const std::string& text, std::size_t begin = 0)
{
    return text.compare(begin, 3, "if(") == 0 || text.compare(begin, 7, "switch(") == 0;
}

/// @return where the word ends that begins there: at a ':' or '?', but not within if() or switch().
std::size_t endOfWord(const std::string& text, std::size_t begin)
{
    std::size_t end = begin;
    if (isBranch(text, begin)) {
        end = text.find('(', begin);
        for (int depth = 1; depth > 0;) {
            end = text.find_first_of("()", end + 1);
            if (end == text.npos) throwUsage("a ')' is missing");
            depth += text[end] == '(' ? 1 : -1;
        }
    }
    return std::min(text.find_first_of(":?", end), text.size());
}

/// @return what is between the separators, ':' or '?', that are not within if() or switch().
std::vector<std::string> partsOf(const std::string& text, char separator)
{
    std::vector<std::string> parts(1);
    for (std::size_t begin = 0;;) {
        const std::size_t end = endOfWord(text, begin);
        parts.back() += text.substr(begin, end - begin);
        if (end == text.size()) return parts;
        if (text[end] == separator) parts.emplace_back();
        else parts.back() += text[end];
        begin = end + 1;
    }
}

/// Evaluates the words of one expression.
class Evaluator {
public:
    explicit Evaluator(Evaluation& evaluation) : mEvaluation(evaluation) {}

    void evaluate(const std::string& words, int depth = 0)
    {
        constexpr int kDeepest = 16;
        if (depth == kDeepest) throwUsage("if() and switch() are more than 16 deep");
        for (const std::string& word : partsOf(words, ':')) {
            if (mHasQuit) return;
            if (!word.empty()) run(word, depth);
        }
    }

private:
    void run(const std::string& word, int depth)
    {
        if (const Function* function = findFunction(word)) return call(*function);
        if (word == "quit") mHasQuit = true;
        else if (word[0] == '$') load(word.substr(1));
        else if (word[0] == '@') store(word.substr(1));
        else if (isBranch(word)) branch(word, depth);
        else mEvaluation.operands.push(word);
    }

    void call(const Function& function)
    {
        const std::size_t there = mEvaluation.operands.size();
        if (there < function.operands) {
            throwUsage(function.name + " takes "
                + (function.operands == 1 ? "a value"
                                          : std::to_string(function.operands) + " values")
                + " before it, and there " + (there == 1 ? "is " : "are ")
                + (there == 0 ? "none" : std::to_string(there)));
        }
        try {
            function.run(mEvaluation);
        } catch (const CommandError& error) {
            throw CommandError(error.code(), function.name + ": " + error.what());
        }
    }

    void load(const std::string& name)
    {
        Variables& variables = mEvaluation.variables;
        if (variables.isUnknown(name)) throw NeedsStack();
        const auto value = variables.get(name);
        if (!value) {
            throwUsage("there is no variable $" + openvdb_spheretree::detail::onOneLine(name, 60)
                + didYouMean(name, variables.names()));
        }
        mEvaluation.operands.push(*value);
    }

    void store(const std::string& name)
    {
        if (name.empty()) throwUsage("a name is missing after @");
        if (mEvaluation.operands.size() == 0) throwUsage("@" + name + " has no value to store");
        mEvaluation.variables.set(name, mEvaluation.operands.pop());
    }

    void branch(const std::string& word, int depth)
    {
        if (word.back() != ')') throwUsage("a ':' is missing after a ')'");
        const bool isIf = word[0] == 'i';
        const std::size_t begin = word.find('(') + 1;
        const auto cases = partsOf(word.substr(begin, word.size() - begin - 1), '?');
        if (mEvaluation.operands.size() == 0) {
            throwUsage(word.substr(0, begin - 1) + "() takes a value before it");
        }
        if (isIf) runIf(cases, depth);
        else runSwitch(cases, depth);
    }

    void runIf(const std::vector<std::string>& cases, int depth)
    {
        if (cases.size() > 2) throwUsage("if() has two parts, as in if(a?b), and not more");
        if (mEvaluation.operands.popBool()) evaluate(cases[0], depth + 1);
        else if (cases.size() == 2) evaluate(cases[1], depth + 1);
    }

    void runSwitch(const std::vector<std::string>& cases, int depth)
    {
        const std::string value = mEvaluation.operands.pop();
        for (const std::string& one : cases) {
            const std::size_t colon = one.find(':');
            if (colon == std::string::npos) {
                throwUsage("a part of switch() has no ':', as in switch(1:a?2:b)");
            }
            if (one.substr(0, colon) == value) return evaluate(one.substr(colon + 1), depth + 1);
        }
        throwUsage("switch() has no part for " + inQuotes(value));
    }

    Evaluation& mEvaluation;
    bool mHasQuit = false;
};

/// @return what is likely meant where more than one value is left: a name of a function, misspelt.
std::string hintOn(const std::vector<std::string>& values)
{
    std::vector<std::string> names;
    for (const Function& function : allFunctions()) names.push_back(function.name);
    for (auto value = values.rbegin(); value != values.rend(); ++value) {
        if (value->size() < 3 || numberOf(*value)) continue;
        const std::string hint = didYouMean(*value, names);
        if (!hint.empty()) return "; there is no function " + inQuotes(*value) + hint;
    }
    return "";
}

std::string resultOf(const Operands& operands)
{
    const auto& values = operands.values();
    if (values.empty()) return "";
    if (values.size() == 1) return values.front();
    constexpr std::size_t kShown = 4;
    std::string all;
    for (std::size_t i = 0; i < std::min(values.size(), kShown); ++i) {
        all += (i ? ", " : "") + openvdb_spheretree::detail::onOneLine(values[i], 40);
    }
    if (values.size() > kShown) all += ", ...";
    throwUsage("it ends in " + std::to_string(values.size()) + " values and not in one (" + all
        + ")" + hintOn(values) + "; squash makes one of all");
}

/// In double quotes the shell has put nothing in the place of `$i`.
std::string quoteHint(const std::string& words)
{
    if (!words.empty() && words[0] != ':') return "";
    return "; if there was a variable in it, put single quotes around: '{$i}'";
}

std::string valueOf(const std::string& words, Variables& variables, const StackFacts* stack)
{
    const std::string shown = "{" + openvdb_spheretree::detail::onOneLine(words, 80) + "}: ";
    try {
        if (words.empty()) throwUsage("the expression is empty");
        Evaluation evaluation{{}, variables, stack};
        Evaluator(evaluation).evaluate(words);
        return resultOf(evaluation.operands);
    } catch (const CommandError& error) {
        throw CommandError(error.code(), shown + error.what() + quoteHint(words));
    }
}

/// Calls @a expression with what is within each pair of braces, and @a plain with what is between.
template <typename Plain, typename Inner>
void forParts(const std::string& text, const Plain& plain, const Inner& expression)
{
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t open = text.find_first_of("{}", begin);
        plain(text.substr(begin, open == text.npos ? text.npos : open - begin));
        if (open == text.npos) return;
        const std::size_t close = text.find_first_of("{}", open + 1);
        if (text[open] == '}') throwUsage(inQuotes(text) + " has a '}' without a '{' before it");
        if (close == text.npos) throwUsage(inQuotes(text) + " has a '{' without a '}' after it");
        if (text[close] == '{') throwUsage(inQuotes(text) + " has a '{' within braces");
        expression(text.substr(open + 1, close - open - 1));
        begin = close + 1;
    }
}

void setWordsUnknown(const std::string& words, Variables& variables)
{
    std::string before;
    // Of all branches: nobody knows which one it will be.
    for (std::size_t begin = 0; begin <= words.size();) {
        const std::size_t end = std::min(words.find_first_of(":?()", begin), words.size());
        const std::string word = words.substr(begin, end - begin);
        if (word.size() > 1 && word[0] == '@') variables.setUnknown(word.substr(1));
        const bool isPlain = !before.empty() && before[0] != '$' && !findFunction(before);
        if (word == "set" && isPlain) variables.setUnknown(before);
        if (word == "set" && !isPlain) {
            for (const std::string& name : variables.names()) variables.setUnknown(name);
        }
        before = word;
        begin = end + 1;
    }
}

} // namespace

bool hasExpression(const std::string& text) { return text.find_first_of("{}") != text.npos; }

std::string evaluate(const std::string& text, Variables& variables, const StackFacts* stack)
{
    std::string result;
    forParts(
        text, [&](const std::string& plain) { result += plain; },
        [&](const std::string& words) { result += valueOf(words, variables, stack); });
    return result;
}

void setStoredUnknown(const std::string& text, Variables& variables)
{
    forParts(
        text, [](const std::string&) {},
        [&](const std::string& words) { setWordsUnknown(words, variables); });
}

} // namespace command
