// SPDX-License-Identifier: Apache-2.0
/// @file Terminal.h
/// @brief Whether a stream is a terminal, and colour for those that are.

#pragma once

#include <iosfwd>
#include <string>

namespace command {

enum class Colour { Red, Green, Yellow, Bold };

/// @return whether std::cout or std::cerr (no other stream) is a terminal.
bool isTerminal(const std::ostream& stream);

/// @return @a text, coloured where @a stream is a terminal and the user has not set NO_COLOR.
std::string coloured(const std::ostream& stream, Colour colour, const std::string& text);

/// @return a duration as people read it: `3.1 ms`, `12.6 s`.
std::string prettySeconds(double seconds);

/// @return a whole number with a comma between thousands.
std::string withCommas(long long number);

} // namespace command
