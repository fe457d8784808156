// SPDX-License-Identifier: Apache-2.0
/// @file Text.h
/// @brief Text of files and file names, as readers and their messages need it.

#pragma once

#include <cctype>
#include <filesystem>
#include <string>
#include <string_view>

namespace openvdb_spheretree {
namespace detail {

/// @return `.obj` of `path/Part.OBJ`.
inline std::string lowerExtension(const std::string& path)
{
    std::string text = std::filesystem::path(path).extension().string();
    for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// @return text of a file for use in a message: in quotes, short, and nothing a terminal would
/// obey.
inline std::string shown(std::string_view text)
{
    constexpr std::size_t kLongest = 40;
    std::string clean(text.substr(0, kLongest));
    for (char& c : clean) {
        if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
    }
    return "'" + clean + (text.size() > kLongest ? "...'" : "'");
}

} // namespace detail
} // namespace openvdb_spheretree
