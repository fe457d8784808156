// SPDX-License-Identifier: Apache-2.0
#include "Assignment.h"

#include <limits>

namespace openvdb_spheretree::detail {

namespace {

constexpr std::size_t kNone = ~std::size_t(0);

/// Potentials keep all reduced costs, cost - rowPotential - columnPotential, at 0 or more; those of
/// assigned pairs are 0.
struct Duals {
    std::vector<double> row, column;
};

/// A search for the cheapest path from a row to a column that is free (Dijkstra's algorithm).
struct PathSearch {
    explicit PathSearch(std::size_t columns)
        : distance(columns, std::numeric_limits<double>::infinity()), cameFrom(columns, kNone),
          isDone(columns, false)
    {}

    std::vector<double> distance;
    std::vector<std::size_t> cameFrom; ///< the column before; kNone: the row that is to be assigned
    std::vector<bool> isDone;
};

/// Takes the edges of a row into the search. @return the open column that is nearest
std::size_t relax(PathSearch& search, const double* costs, double rowPotential, double reached,
    std::size_t column, const Duals& duals)
{
    std::size_t nearest = kNone;
    for (std::size_t j = 0; j < search.distance.size(); ++j) {
        if (search.isDone[j]) continue;
        const double distance = reached + (costs[j] - rowPotential - duals.column[j]);
        if (distance < search.distance[j]) {
            search.distance[j] = distance;
            search.cameFrom[j] = column;
        }
        if (nearest == kNone || search.distance[j] < search.distance[nearest]) nearest = j;
    }
    return nearest;
}

} // namespace

std::vector<std::size_t> cheapestAssignment(
    std::size_t rows, std::size_t columns, const std::vector<double>& costs)
{
    Duals duals{std::vector<double>(rows, 0.0), std::vector<double>(columns, 0.0)};
    std::vector<std::size_t> rowOf(columns, kNone), columnOf(rows, kNone);
    for (std::size_t start = 0; start < rows; ++start) {
        PathSearch search(columns);
        std::size_t row = start, column = kNone;
        double reached = 0;
        for (;;) {
            const double* const ofRow = costs.data() + row * columns;
            column = relax(search, ofRow, duals.row[row], reached, column, duals);
            reached = search.distance[column];
            search.isDone[column] = true;
            if (rowOf[column] == kNone) break;
            row = rowOf[column];
        }
        // Columns that were passed come nearer, by what they were nearer than the end of the path.
        duals.row[start] += reached;
        for (std::size_t j = 0; j < columns; ++j) {
            if (!search.isDone[j] || rowOf[j] == kNone) continue;
            duals.row[rowOf[j]] += reached - search.distance[j];
            duals.column[j] -= reached - search.distance[j];
        }
        while (column != kNone) { // each column on the path gets the row of the one before
            const std::size_t before = search.cameFrom[column];
            rowOf[column] = before == kNone ? start : rowOf[before];
            columnOf[rowOf[column]] = column;
            column = before;
        }
    }
    return columnOf;
}

} // namespace openvdb_spheretree::detail
