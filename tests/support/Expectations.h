// SPDX-License-Identifier: Apache-2.0
/// @file Expectations.h
/// @brief What heuristics reach today, from tests/data/expectations.txt. A test of a heuristic
/// holds its result against the figure of its name: who makes one better changes the table alone.

#pragma once

#include <string>

namespace spheretree_test {

/// @return the figure of that name; not a number, and a failure, if the table has none or two.
double expectedFigure(const std::string& name);

} // namespace spheretree_test
