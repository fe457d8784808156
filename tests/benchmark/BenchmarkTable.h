// SPDX-License-Identifier: Apache-2.0
/// @file BenchmarkTable.h
/// @brief The table that the benchmark prints: a line a measurement, then a line a growth exponent.

#pragma once

#include "Growth.h"
#include "Measurement.h"

#include <iosfwd>
#include <vector>

namespace spheretree_benchmark {

void printHeader(std::ostream& out);
void printLine(std::ostream& out, const Measurement& measurement);
/// Nothing, if there are none.
void printGrowth(std::ostream& out, const std::vector<Growth>& growths);

} // namespace spheretree_benchmark
