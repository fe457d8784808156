// SPDX-License-Identifier: Apache-2.0
#include "Expectations.h"

#include "DataFolder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <sstream>

namespace spheretree_test {

double expectedFigure(const std::string& name)
{
    std::ifstream table(dataPath("expectations.txt"));
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
