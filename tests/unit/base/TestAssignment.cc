// SPDX-License-Identifier: Apache-2.0

#include <openvdb_spheretree/base/Assignment.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <set>

namespace {

using openvdb_spheretree::detail::cheapestAssignment;

double costOf(
    const std::vector<std::size_t>& columns, std::size_t width, const std::vector<double>& costs)
{
    double sum = 0;
    for (std::size_t row = 0; row < columns.size(); ++row) sum += costs[row * width + columns[row]];
    return sum;
}

/// All ways to choose columns for the rows.
double leastCost(std::size_t rows, std::size_t columns, const std::vector<double>& costs)
{
    std::vector<std::size_t> order(columns);
    std::iota(order.begin(), order.end(), std::size_t(0));
    double least = std::numeric_limits<double>::infinity();
    do {
        const std::vector<std::size_t> chosen(order.begin(), order.begin() + std::ptrdiff_t(rows));
        least = std::min(least, costOf(chosen, columns, costs));
    } while (std::next_permutation(order.begin(), order.end()));
    return least;
}

TEST(Assignment, CostsNoMoreThanAnyOther)
{
    std::mt19937 random(5);
    std::uniform_int_distribution<int> cost(0, 9); // with many ties
    for (std::size_t rows = 1; rows <= 6; ++rows) {
        for (std::size_t columns = rows; columns <= 7; ++columns) {
            for (int trial = 0; trial < 20; ++trial) {
                std::vector<double> costs(rows * columns);
                for (double& each : costs) each = cost(random) - 3;
                const auto found = cheapestAssignment(rows, columns, costs);
                ASSERT_EQ(found.size(), rows);
                ASSERT_EQ(std::set<std::size_t>(found.begin(), found.end()).size(), rows);
                ASSERT_EQ(costOf(found, columns, costs), leastCost(rows, columns, costs))
                    << rows << " x " << columns << ", trial " << trial;
            }
        }
    }
}

TEST(Assignment, FindsAHiddenPermutation)
{
    const std::size_t n = 300;
    std::mt19937 random(7);
    std::vector<std::size_t> hidden(n);
    std::iota(hidden.begin(), hidden.end(), std::size_t(0));
    std::shuffle(hidden.begin(), hidden.end(), random);
    std::uniform_real_distribution<double> cost(1, 2);
    std::vector<double> costs(n * n);
    for (double& each : costs) each = cost(random);
    for (std::size_t row = 0; row < n; ++row) costs[row * n + hidden[row]] = 0.5;
    EXPECT_EQ(cheapestAssignment(n, n, costs), hidden);
}

TEST(Assignment, NothingIsAssignedToNobody) { EXPECT_TRUE(cheapestAssignment(0, 3, {}).empty()); }

} // namespace
