// SPDX-License-Identifier: Apache-2.0
/// @file FuzzExpression.cc
/// @brief Fuzz target: expressions in values of options, and frame numbers in names.

#include "FuzzTarget.h"

#include <base/Errors.h>
#include <expression/Expression.h>
#include <expression/FrameName.h>

namespace {

using spheretree_test::require;

constexpr std::size_t kLongestFrame = 64; // that a place in a name grows by

/// Has one grid, and tells the same of it whatever is asked.
class OneGrid : public command::StackFacts {
public:
    std::string fact(const std::string&, int64_t age) const override
    {
        if (age != 0) command::throwInput("there is one");
        return "42";
    }
    std::string count(const std::string&) const override { return "1"; }
};

void evaluate(const std::string& text, const command::StackFacts* stack)
{
    command::Variables variables;
    variables.set("i", "7");
    variables.set("file", "/a/b/smoke_0012.vdb");
    try {
        const std::string value = command::evaluate(text, variables, stack);
        // Each expression has two braces at least.
        require(value.size() <= text.size() * command::Operands::kMostBytes, "a value too long");
        command::setStoredUnknown(text, variables);
    } catch (const command::NeedsStack&) {
        require(!stack, "the stack is there, and is asked for");
    } catch (const command::CommandError& error) {
        require(error.code() == command::kUsage || error.code() == command::kInput, "a code");
        require(std::string(error.what()).size() < 4096 + text.size(), "a message too long");
    }
}

void readFrames(const std::string& text)
{
    const bool has = command::hasFrame(text);
    const std::string name = command::withFrame(text, -12);
    require(has || name == text, "a name without a place that changes");
    require(name.size() <= text.size() * kLongestFrame, "a name too long");
    try {
        const auto frames = command::framesOfRange(text);
        require(!frames.empty() && frames.size() <= command::kMostFrames, "a number of frames");
    } catch (const command::CommandError& error) {
        require(error.code() == command::kUsage, "a code of a range");
    }
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    const std::string text = spheretree_test::textOf(data, size);
    const OneGrid grid;
    evaluate(text, nullptr);
    evaluate(text, &grid);
    readFrames(text);
    return 0;
}
