// SPDX-License-Identifier: Apache-2.0
/// @file Expectations.h
/// @brief What heuristics reach today, from tests/data/expectations.txt. A test of a heuristic
/// holds its result against the figure of its name: who makes one better changes the table alone.

#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace spheretree_test {

/// @return the figure of that name; not a number, and a failure, if the table has none or two.
inline double expectedFigure(const std::string& name)
{
    std::ifstream table(std::string(SPHERETREE_TEST_DATA) + "/expectations.txt");
    EXPECT_TRUE(table) << "no file tests/data/expectations.txt";
    double found = std::numeric_limits<double>::quiet_NaN();
    int lines = 0;
    for (std::string line; std::getline(table, line);) {
        std::istringstream words(line);
        std::string word;
        double figure = 0;
        if (words >> word && word == name && words >> figure) {
            found = figure;
            ++lines;
        }
    }
    EXPECT_EQ(lines, 1) << "figures named " << name << " in tests/data/expectations.txt";
    return found;
}

} // namespace spheretree_test
