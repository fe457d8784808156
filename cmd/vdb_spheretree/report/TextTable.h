// SPDX-License-Identifier: Apache-2.0
/// @file TextTable.h
/// @brief Rows of cells as columns for people, in several tables below one another where a terminal is
/// narrower than that.

#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <vector>

namespace command {

using Row = std::vector<std::string>;

/// @return a number with so many digits after the point.
std::string fixed(double number, int digits);

/// @param rows    the first one is the header
/// @param second  the column that the second table begins with, where there are more than one
/// @param limit   characters a line; 0: any
void printRows(
    std::ostream& out, const std::vector<Row>& rows, std::size_t second, std::size_t limit);

} // namespace command
