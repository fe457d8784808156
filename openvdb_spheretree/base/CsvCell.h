// SPDX-License-Identifier: Apache-2.0
/// @file CsvCell.h
/// @brief A text as a cell of a table, as RFC 4180 has it. Its reader is CsvTable.h.

#pragma once

#include <string>

namespace openvdb_spheretree::detail {

/// @param special  in double quotes where it has one of these, double quotes among them, which are doubled
inline std::string csvCell(const std::string& text, const char* special = ",\"\r\n")
{
    if (text.find_first_of(special) == text.npos) return text;
    std::string cell = "\"";
    for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
    return cell + "\"";
}

} // namespace openvdb_spheretree::detail
