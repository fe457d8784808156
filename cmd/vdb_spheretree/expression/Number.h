// SPDX-License-Identifier: Apache-2.0
/// @file Number.h
/// @brief Numbers of expressions. They are texts, as all values are; a whole number stays one until it
/// meets another kind.
///
/// As in vdb_tool, other numbers are floats of 32 bits, and have six decimals as a text: the same
/// expression gives the same text. Ours differs where its text would lose the number (0.0000012), and
/// where its whole numbers, of 32 bits, overflow.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace command {

using Number = std::variant<int64_t, float>;

/// @return the number that the text is, blanks before it left out; nothing if it is none, or not
///         finite.
std::optional<Number> numberOf(const std::string& text);

inline bool isWhole(const Number& number) { return std::holds_alternative<int64_t>(number); }
float realOf(const Number& number);

/// @throw CommandError (usage) if it is not finite
std::string textOf(const Number& number);
/// The same of what is measured in doubles.
std::string textOfReal(double number);

} // namespace command
