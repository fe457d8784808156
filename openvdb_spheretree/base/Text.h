// SPDX-License-Identifier: Apache-2.0
/// @file Text.h
/// @brief Text from outside, made fit for messages: it may be damaged, and gigabytes long.

#pragma once

#include <cctype>
#include <charconv>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace openvdb_spheretree::detail {

inline std::string lowerCase(std::string_view text)
{
    std::string lower(text);
    for (char& c : lower) c = char(std::tolower(static_cast<unsigned char>(c)));
    return lower;
}

/// @return `.obj` of `path/Part.OBJ`.
inline std::string lowerExtension(const std::string& path)
{
    return lowerCase(std::filesystem::path(path).extension().string());
}

/// @return the start of a text, of @a longest bytes at most. No letter of UTF-8 is cut.
inline std::string_view startOf(std::string_view text, std::size_t longest)
{
    if (text.size() <= longest) return text;
    constexpr std::size_t kLongestLetter = 4;
    const auto isWithinLetter = [&](std::size_t at) {
        return (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80;
    };
    std::size_t end = longest;
    while (end > 0 && longest - end < kLongestLetter && isWithinLetter(end)) --end;
    return text.substr(0, isWithinLetter(end) ? longest : end);
}

/// @return the text on one line, its control characters replaced; where it is longer than @a
/// longest, its start and "...".
inline std::string onOneLine(std::string_view text, std::size_t longest)
{
    std::string line(startOf(text, longest));
    for (char& c : line) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte == '\n' || byte == '\t') c = ' ';
        else if (byte < 32 || byte == 127) c = '?';
    }
    return text.size() > longest ? line + "..." : line;
}

/// @return the same in quotes.
inline std::string inQuotes(std::string_view text, std::size_t longest = 60)
{
    return "'" + onOneLine(text, longest) + "'";
}

/// @return a message of OpenVDB's without the type of the exception at its start.
inline std::string_view withoutType(std::string_view message)
{
    constexpr std::string_view kEnd = "Error: ";
    constexpr std::size_t kLongestType = 20;
    const std::size_t end = message.substr(0, kLongestType + kEnd.size()).find(kEnd);
    if (end == message.npos || message.find_first_of(" \t\n") < end) return message;
    return message.substr(end + kEnd.size());
}

/// @return the first line of an error's message, without its type and of a sane length.
inline std::string messageOf(const std::exception& error)
{
    constexpr std::size_t kLongest = 400;
    const std::string_view message = withoutType(error.what());
    return std::string(startOf(message.substr(0, message.find('\n')), kLongest));
}

/// @return a number for messages, with four digits that count.
inline std::string shortNumber(double number)
{
    char text[32];
    std::snprintf(text, sizeof(text), "%.4g", number);
    return text;
}

/// @return the number that the whole text is; nothing if it is none, or out of the type's range.
template <typename Number>
std::optional<Number> parseNumber(std::string_view text)
{
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end) return {};
    return number;
}

} // namespace openvdb_spheretree::detail
