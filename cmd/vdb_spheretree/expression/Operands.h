// SPDX-License-Identifier: Apache-2.0
/// @file Operands.h
/// @brief The stack of values that the functions of an expression take from and leave on. A value is a
/// text.

#pragma once

#include "Number.h"

#include <cstddef>
#include <string>
#include <vector>

namespace command {

class Operands {
public:
    static constexpr std::size_t kMostBytes = 1 << 16; ///< of all values together
    static constexpr std::size_t kMost = 1 << 12;      ///< values

    /// @throw CommandError (usage) if there would be too many, or too long ones
    void push(const std::string& value);
    void push(const Number& number) { push(textOf(number)); }
    void push(bool value) { push(std::string(value ? "1" : "0")); }
    void push(const char*) = delete; // would be taken for a bool

    std::string pop();
    /// @name @throw CommandError (usage) if the value is none
    /// @{
    Number popNumber();
    int64_t popWhole();
    bool popBool(); ///< 0, 1, true or false
    /// @}

    /// @param depth  0: the last one
    const std::string& at(std::size_t depth) const { return mValues[mValues.size() - 1 - depth]; }
    void clear();
    std::size_t size() const { return mValues.size(); }
    const std::vector<std::string>& values() const { return mValues; }

private:
    std::vector<std::string> mValues;
    std::size_t mBytes = 0;
};

/// @throw CommandError (usage)
bool boolOf(const std::string& value);

} // namespace command
