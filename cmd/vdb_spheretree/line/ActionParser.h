// SPDX-License-Identifier: Apache-2.0
/// @file ActionParser.h
/// @brief The grammar of the command line, which is that of vdb_tool: a chain of actions, each with
/// its options, `-action option=value option=value`.
///
/// - An action starts with any number of dashes.
/// - An option may be shortened to a prefix that no other option of its action starts with.
/// - A token without `=` goes to the action's main option.
///
/// It is stricter than vdb_tool: what is unknown, ambiguous, empty or given twice is an error, and
/// every value is checked against its range. The whole line is parsed before any action runs.

#pragma once

#include "Action.h"

#include <string>
#include <vector>

namespace command {

/// @throw CommandError (usage; or input, where a file of -config cannot be read)
std::vector<ActionCall> parseLine(const std::vector<std::string>& tokens);

} // namespace command
