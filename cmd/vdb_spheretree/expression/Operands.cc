// SPDX-License-Identifier: Apache-2.0
#include "Operands.h"

#include "base/Errors.h"

#include <openvdb_spheretree/base/Text.h>

namespace command {

using openvdb_spheretree::detail::inQuotes;

void Operands::push(const std::string& value)
{
    if (mValues.size() >= kMost) {
        throwUsage("there are more than " + std::to_string(kMost) + " values");
    }
    if (mBytes + value.size() > kMostBytes) {
        throwUsage("the values take more than " + std::to_string(kMostBytes) + " bytes");
    }
    mBytes += value.size();
    mValues.push_back(value);
}

std::string Operands::pop()
{
    if (mValues.empty()) throwUsage("a value is missing");
    const std::string value = mValues.back();
    mValues.pop_back();
    mBytes -= value.size();
    return value;
}

Number Operands::popNumber()
{
    const std::string value = pop();
    const auto number = numberOf(value);
    if (!number) throwUsage(inQuotes(value) + " is no number");
    return *number;
}

int64_t Operands::popWhole()
{
    const std::string value = pop();
    const auto number = numberOf(value);
    if (!number || !isWhole(*number)) throwUsage(inQuotes(value) + " is no whole number");
    return std::get<int64_t>(*number);
}

bool Operands::popBool() { return boolOf(pop()); }

void Operands::clear()
{
    mValues.clear();
    mBytes = 0;
}

bool boolOf(const std::string& value)
{
    if (value == "1" || value == "true") return true;
    if (value == "0" || value == "false") return false;
    throwUsage(inQuotes(value) + " is neither true nor false: it takes 1, 0, true or false");
}

} // namespace command
