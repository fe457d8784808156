// SPDX-License-Identifier: Apache-2.0
/// @file Trimmed.h
/// @brief A text without blanks around it.

#pragma once

#include <string>

namespace openvdb_spheretree::detail {

/// @return the text from its first to its last letter that is none of @a blanks.
inline std::string trimmed(const std::string& text, const char* blanks = " \t")
{
    const auto begin = text.find_first_not_of(blanks);
    if (begin == std::string::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

} // namespace openvdb_spheretree::detail
