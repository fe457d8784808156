// SPDX-License-Identifier: Apache-2.0
/// @file LogicFunctions.cc
/// @brief Comparisons, and what is made of them. Two numbers are compared as numbers, anything else as
/// text.

#include "Functions.h"

namespace command {

namespace {

/// @return less than 0, 0, or more.
int compared(const std::string& a, const std::string& b)
{
    const auto x = numberOf(a), y = numberOf(b);
    if (!x || !y) return a.compare(b);
    if (isWhole(*x) && isWhole(*y)) return (*x > *y) - (*x < *y);
    return (realOf(*x) > realOf(*y)) - (realOf(*x) < realOf(*y));
}

Function comparison(const std::string& name, const std::string& doc, bool (*holds)(int))
{
    return {name, 2, doc, [holds](Evaluation& e) {
                const std::string b = e.operands.pop(), a = e.operands.pop();
                e.operands.push(holds(compared(a, b)));
            }};
}

Function logic(const std::string& name, const std::string& doc, bool (*function)(bool, bool))
{
    return {name, 2, doc, [function](Evaluation& e) {
                const bool b = e.operands.popBool(), a = e.operands.popBool();
                e.operands.push(function(a, b));
            }};
}

} // namespace

std::vector<Function> logicFunctions()
{
    return {
        comparison("==", "{1:2:==} -> 0", [](int sign) { return sign == 0; }),
        comparison("!=", "{1:2:!=} -> 1", [](int sign) { return sign != 0; }),
        comparison("<", "{1:2:<} -> 1", [](int sign) { return sign < 0; }),
        comparison("<=", "{1:2:<=} -> 1", [](int sign) { return sign <= 0; }),
        comparison(">", "{1:2:>} -> 0", [](int sign) { return sign > 0; }),
        comparison(">=", "{1:2:>=} -> 0", [](int sign) { return sign >= 0; }),
        {"!", 1, "{1:!} -> 0", [](Evaluation& e) { e.operands.push(!e.operands.popBool()); }},
        logic("&", "{1:0:&} -> 0", [](bool a, bool b) { return a && b; }),
        logic("|", "{1:0:|} -> 1", [](bool a, bool b) { return a || b; }),
    };
}

} // namespace command
