// SPDX-License-Identifier: Apache-2.0
#include "TextTable.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <ostream>

namespace command {

namespace {

using Columns = std::vector<std::size_t>;

/// @return the columns of tables below one another, each with the first one, that are no wider than
///         @a limit as far as that is possible; all in one if there is no limit (0).
/// @param second  the column that the second table begins with, where there are more than one
std::vector<Columns> tablesOf(
    const std::vector<std::size_t>& width, std::size_t second, std::size_t limit)
{
    constexpr std::size_t kGap = 2;
    const std::size_t all = std::accumulate(width.begin(), width.end(), kGap * (width.size() - 1));
    const bool split = limit > 0 && all > limit;
    std::vector<Columns> tables(1);
    std::size_t used = 0;
    for (std::size_t i = 0; i < width.size(); ++i) {
        const bool full = tables.back().size() > 1 && used + kGap + width[i] > limit;
        if (split && i > 0 && (full || i == second)) {
            tables.push_back({0});
            used = width[0];
        }
        used += width[i] + (i > 0 ? kGap : 0);
        tables.back().push_back(i);
    }
    return tables;
}

} // namespace

std::string fixed(double number, int digits)
{
    char text[64];
    std::snprintf(text, sizeof(text), "%.*f", digits, number);
    return text;
}

void printRows(
    std::ostream& out, const std::vector<Row>& rows, std::size_t second, std::size_t limit)
{
    std::vector<std::size_t> width(rows.front().size(), 0);
    for (const Row& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    }
    for (const Columns& columns : tablesOf(width, second, limit)) {
        for (const Row& row : rows) {
            for (const std::size_t i : columns) {
                out << (i ? "  " : "") << std::string(width[i] - row[i].size(), ' ') << row[i];
            }
            out << "\n";
        }
    }
}

} // namespace command
