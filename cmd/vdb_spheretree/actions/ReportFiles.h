// SPDX-License-Identifier: Apache-2.0
/// @file ReportFiles.h
/// @brief Where an action puts its report: .json and .csv files in place of a table for people.

#pragma once

#include "line/Action.h"
#include "line/Plan.h"
#include "session/Session.h"

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace command {

/// Options files=, json= and csv=.
/// @param what  of the first one: what the files hold
std::vector<OptionSpec> reportOptions(
    const std::string& files, const std::string& json, const std::string& csv);

/// @throw CommandError (usage or output)
void checkReportFiles(const ActionCall& call, Plan& plan);

/// @return whether the report goes to files, or as JSON or CSV to stdout: else it is a table.
bool hasReportFiles(const ActionCall& call);

/// @brief Write all of them, or none.
/// @param write  writes the report as "json" or "csv"
void writeReportFiles(const ActionCall& call, Session& session,
    const std::function<void(std::ostream& out, const std::string& form)>& write);

} // namespace command
