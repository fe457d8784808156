// SPDX-License-Identifier: Apache-2.0
/// @file WriteChart.h
/// @brief The curves of -write: errors of trees against their numbers of spheres.

#pragma once

#include "session/Session.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace command {

/// The format= that makes a .png or .csv a chart. A .svg always is one.
inline constexpr const char* kChartFormat = "curve";

/// @return what -help lists of them, as exportFormatDocs() does.
std::vector<std::pair<std::string, std::string>> chartDocs();

/// @return whether a file of this name is a chart.
bool isChart(const ActionCall& call, const std::string& path);

/// @throw CommandError (usage) if a chart cannot be written
void checkCharts(const ActionCall& call);

/// @brief Count the errors that charts of @a call show: before any file is written, since all of them have
/// what is known of a tree.
/// @throw CommandError (input) if there is no tree, or the errors of one are not known, nor its object
void countErrorsOfCharts(
    const ActionCall& call, const std::vector<StackItem*>& items, Session& session);

/// Write a chart of all trees of @a items.
void writeChart(const ActionCall& call, const std::string& path,
    const std::vector<StackItem*>& items, std::ostream& out);

} // namespace command
