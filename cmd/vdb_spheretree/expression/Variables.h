// SPDX-License-Identifier: Apache-2.0
/// @file Variables.h
/// @brief The variables of a command line: those of loops, and those that expressions store.
///
/// Before any work is done, a variable may be *unknown*: it will be stored by an expression that asks
/// for what is on the stack then.

#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace command {

using Assignment = std::pair<std::string, std::string>;

class Variables {
public:
    /// @return the value; also of `pi` and `e`, where nobody has stored others. Nothing if there is none.
    std::optional<std::string> get(const std::string& name) const;
    bool isSet(const std::string& name) const { return mValues.count(name) > 0; }
    bool isUnknown(const std::string& name) const { return mUnknown.count(name) > 0; }
    /// All names that have a value, for messages.
    std::vector<std::string> names() const;

    void set(const std::string& name, const std::string& value);
    void setUnknown(const std::string& name);
    void erase(const std::string& name);

    /// @return what has been set since the last call, in order.
    std::vector<Assignment> takeAssigned() { return std::exchange(mAssigned, {}); }

private:
    std::map<std::string, std::string> mValues;
    std::set<std::string> mUnknown;
    std::vector<Assignment> mAssigned;
};

} // namespace command
