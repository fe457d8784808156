// SPDX-License-Identifier: Apache-2.0
/// @file base/Assignment.h
/// @brief The assignment problem: who of one set goes with whom of another, so that the sum of costs is the
/// least.
///
/// H. W. Kuhn, "The Hungarian method for the assignment problem", 1955, by shortest augmenting paths with
/// potentials (R. Jonker and A. Volgenant, "A shortest augmenting path algorithm for dense and sparse linear
/// assignment problems", 1987). Each row in turn is assigned along the path that costs least.
///
/// Exact up to the rounding of doubles. Cost: rows^2 x columns at most. Of several best answers it is always the
/// same one.

#pragma once

#include <cstddef>
#include <vector>

namespace openvdb_spheretree::detail {

/// @param rows, columns  at least as many columns as rows
/// @param costs          row by row; finite
/// @return the column of each row, each column once.
std::vector<std::size_t> cheapestAssignment(
    std::size_t rows, std::size_t columns, const std::vector<double>& costs);

} // namespace openvdb_spheretree::detail
