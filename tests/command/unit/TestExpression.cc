// SPDX-License-Identifier: Apache-2.0
// Expressions of the command line. That most results are vdb_tool's is tested with vdb_tool itself
// (command/TestCommandLoops.cc).

#include <base/Errors.h>
#include <expression/Expression.h>

#include <gtest/gtest.h>

#include <regex>

namespace {

using command::CommandError;
using command::evaluate;
using command::Function;
using command::NeedsStack;
using command::Variables;

std::string valueOf(const std::string& text)
{
    Variables variables;
    variables.set("i", "7");
    variables.set("file", "/a/b/smoke_012.vdb");
    return evaluate(text, variables, nullptr);
}

std::string errorOf(const std::string& text)
{
    try {
        return "no error, but " + valueOf(text);
    } catch (const CommandError& error) {
        EXPECT_EQ(error.code(), command::kUsage);
        return error.what();
    }
}

struct Case {
    const char* text;
    const char* value;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.text; }

class ExpressionValue : public testing::TestWithParam<Case> {};

TEST_P(ExpressionValue, IsAsExpected) { EXPECT_EQ(valueOf(GetParam().text), GetParam().value); }

const Case kValues[] = {
    {"plain", "plain"},
    {"", ""},
    {"a{1}b{2}c", "a1b2c"},
    {"{1:@a}{$a}", "1"},
    {"tree_{$i:4:pad0}.vdb", "tree_0007.vdb"},
    {"{1:if(0:if(a?b)?c)}", "b"}, // within each other
    {"{0:if(a?1:switch(1:x?2:y))}", "x"},
    {"{1:if(a)}{0:if(a)}", "a"},
    {"{$file:path}", "/a/b"},
    {"{$file:base}{$file:number}.{$file:ext}", "smoke_012.vdb"},
    {"{x12y34.vdb:number}", "34"}, // the number at the end alone
    {"{a.b/c:name}", "c"},
    {"{2147483647:1:+}", "2147483648"}, // more than 32 bits
    {"{100000:100000:*}", "10000000000"},
    {"{0.0000012:1.0:*}", "1.2e-06"}, // six decimals would lose it
    {"{a:b:c:squash}", "a,b,c"},
    {"{::1::}", "1"},
    {"{a(b).vdb:file}", "a(b).vdb"},
    {"{7:2:/}", "3"},
    {"{-7:2:/}", "-3"},
    {"{1:quit:2:3}", "1"},
};

INSTANTIATE_TEST_SUITE_P(Values, ExpressionValue, testing::ValuesIn(kValues));

/// Each function tells an example of itself, `{...} -> result`.
TEST(Expression, ExamplesInTheListOfFunctionsHold)
{
    const std::regex example(R"((\{[^}]*\}) -> ([^ ]+))");
    int examples = 0;
    for (const Function& function : command::allFunctions()) {
        std::smatch found;
        EXPECT_FALSE(function.doc.empty()) << function.name;
        if (!std::regex_search(function.doc, found, example)) continue;
        std::string result = found[2];
        if (function.name == "date" || function.name == "uuid") continue; // others each time
        while (!result.empty() && (result.back() == ':' || result.back() == ',')) result.pop_back();
        try {
            const std::string value = valueOf(found[1]);
            EXPECT_EQ(value.substr(0, value.find(' ')), result) << function.name;
            ++examples;
        } catch (const NeedsStack&) {}
    }
    EXPECT_GT(examples, 50);
}

TEST(Expression, DatesAndNumbersOfTheirOwnHaveTheirForm)
{
    EXPECT_TRUE(std::regex_match(valueOf("{date}"),
        std::regex("[A-Z][a-z]{2} [A-Z][a-z]{2} [ 0-9]\\d \\d{2}:\\d{2}:\\d{2} \\d{4}")));
    EXPECT_TRUE(std::regex_match(valueOf("{uuid}"),
        std::regex("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}")));
    EXPECT_NE(valueOf("{uuid}"), valueOf("{uuid}"));
}

class ExpressionError : public testing::TestWithParam<Case> {};

TEST_P(ExpressionError, SaysWhatIsWrong)
{
    const std::string message = errorOf(GetParam().text);
    EXPECT_NE(message.find(GetParam().value), std::string::npos) << message;
}

const Case kErrors[] = {
    {"{}", "the expression is empty; if there was a variable in it, put single quotes around"},
    {"{:4:pad0}", "pad0 takes 2 values before it, and there is 1; if there was a variable"},
    {"{1", "has a '{' without a '}'"},
    {"1}", "has a '}' without a '{'"},
    {"{a:{b}}", "has a '{' within braces"},
    {"{1:2}", "{1:2}: it ends in 2 values and not in one (1, 2)"},
    {"{$i:4:padd}", "there is no function 'padd' (did you mean pad0?)"},
    {"{$j}", "there is no variable $j (did you mean i?)"},
    {"{$}", "there is no variable $"},
    {"{@a}", "@a has no value to store"},
    {"{1:@}", "a name is missing after @"},
    {"{1:+}", "+ takes 2 values before it, and there is 1"},
    {"{+}", "+ takes 2 values before it, and there are none"},
    {"{a:1:+}", "+: 'a' is no number"},
    {"{1:0:/}", "divided by zero"},
    {"{1.0:0:/}", "divided by zero"},
    {"{0:inv}", "divided by zero"},
    {"{-1:sqrt}", "not a finite number"},
    {"{0:ln}", "not a finite number"},
    {"{1e38:10.0:*}", "not a finite number"},
    {"{9223372036854775807:1:+}", "too large for a whole number"},
    {"{9223372036854775807:2:*}", "too large for a whole number"},
    {"{-9223372036854775807:2:-}", "too large for a whole number"},
    {"{1e30:to_int}", "too large for a whole number"},
    {"{10:100:pow}", "too large for a whole number"},
    {"{2:!}", "'2' is neither true nor false"},
    {"{2:if(a?b)}", "'2' is neither true nor false"},
    {"{if(a?b)}", "if() takes a value before it"},
    {"{1:if(a?b}", "a ')' is missing"},
    {"{1:if(a?b?c)}", "if() has two parts"},
    {"{1:if(a)b}", "a ':' is missing after a ')'"},
    {"{3:switch(1:a?2:b)}", "switch() has no part for '3'"},
    {"{3:switch(a?b)}", "a part of switch() has no ':'"},
    {"{12:x:pad0}", "pad0: 'x' is no whole number"},
    {"{12:1000:pad0}", "a width is 0 to 64"},
    {"{smoke:number}", "'smoke' has no number at its end"},
    {"{a.b/smoke:ext}", "'a.b/smoke' has no extension"},
    {"{nosuch:get}", "there is no variable 'nosuch'"},
    {"{-1:gridName}", "an age is 0 or more"},
    {"{x:gridName}", "'x' is no whole number"},
};

INSTANTIATE_TEST_SUITE_P(Errors, ExpressionError, testing::ValuesIn(kErrors));

TEST(Expression, TooMuchIsRefusedAndNotMade)
{
    std::string doubled = "{ab";
    for (int i = 0; i < 40; ++i) doubled += ":dup:append";
    EXPECT_NE(errorOf(doubled + "}").find("bytes"), std::string::npos);
    const std::string replaced =
        "{" + std::string(1000, 'a') + ":a:" + std::string(100, 'b') + ":replace}";
    EXPECT_NE(errorOf(replaced).find("grows too long"), std::string::npos);
    std::string many = "{1";
    for (int i = 0; i < 5000; ++i) many += ":dup";
    EXPECT_NE(errorOf(many + "}").find("more than 4096 values"), std::string::npos);
    std::string deep = "1";
    for (int i = 0; i < 40; ++i) deep = "1:if(" + deep + ")";
    EXPECT_NE(errorOf("{" + deep + "}").find("16 deep"), std::string::npos);
}

TEST(Expression, WhatAsksForTheStackIsOpenBeforeThereIsOne)
{
    EXPECT_THROW(valueOf("{gridCount}"), NeedsStack);
    EXPECT_THROW(valueOf("{0:voxelCount:2:*}"), NeedsStack);
    EXPECT_EQ(valueOf("{0:if(gridCount?5)}"), "5"); // that part is not taken
}

TEST(Expression, VariablesStoredFromTheStackAreUnknownUntilThen)
{
    Variables variables;
    variables.set("n", "1");
    variables.set("i", "2");
    command::setStoredUnknown("{0:voxelCount:@n}", variables);
    EXPECT_THROW(evaluate("{$n}", variables, nullptr), NeedsStack);
    EXPECT_THROW(evaluate("{n:is_set}", variables, nullptr), NeedsStack);
    EXPECT_EQ(evaluate("{$i}", variables, nullptr), "2");
    command::setStoredUnknown("{0:voxelCount:$i:set}", variables); // nobody knows which
    EXPECT_THROW(evaluate("{$i}", variables, nullptr), NeedsStack);
    EXPECT_EQ(evaluate("{3:@i:$i}", variables, nullptr), "3");
}

TEST(Expression, ABranchMayBeTheOneThatStores)
{
    Variables variables;
    command::setStoredUnknown("{gridCount:0:>:if(1:@a?2:b:set)}", variables);
    EXPECT_TRUE(variables.isUnknown("a"));
    EXPECT_TRUE(variables.isUnknown("b"));
}

} // namespace
