// SPDX-License-Identifier: Apache-2.0
#include "Variables.h"

namespace command {

std::optional<std::string> Variables::get(const std::string& name) const
{
    const auto found = mValues.find(name);
    if (found != mValues.end()) return found->second;
    if (name == "pi") return "3.141593"; // with the six decimals that all numbers have
    if (name == "e") return "2.718282";
    return {};
}

std::vector<std::string> Variables::names() const
{
    std::vector<std::string> names;
    for (const auto& [name, value] : mValues) names.push_back(name);
    return names;
}

void Variables::set(const std::string& name, const std::string& value)
{
    mValues[name] = value;
    mUnknown.erase(name);
    mAssigned.emplace_back(name, value);
}

void Variables::setUnknown(const std::string& name)
{
    mValues.erase(name);
    mUnknown.insert(name);
}

void Variables::erase(const std::string& name)
{
    mValues.erase(name);
    mUnknown.erase(name);
}

} // namespace command
