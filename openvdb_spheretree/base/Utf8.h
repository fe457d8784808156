// SPDX-License-Identifier: Apache-2.0
/// @file Utf8.h
/// @brief Tells text in UTF-8 from other bytes (Unicode 15, table 3-7). Exact. Tests: TestUtf8.cc.

#pragma once

#include <cstddef>
#include <string_view>

namespace openvdb_spheretree::detail {

/// What is written where text is no UTF-8: U+FFFD.
constexpr std::string_view kNoLetter = "\xef\xbf\xbd";

/// @return how many bytes the letter at @a at takes in well-formed UTF-8; 0 if there is none.
std::size_t utf8Length(std::string_view text, std::size_t at);

/// @return whether all of it is well-formed UTF-8.
bool isUtf8(std::string_view text);

} // namespace openvdb_spheretree::detail
