// SPDX-License-Identifier: Apache-2.0
/// @file Help.h
/// @brief The texts that explain the command, made from the table of actions.

#pragma once

#include <iosfwd>
#include <string>

namespace command {

/// Prints a line for a name, and goes on below its text.
void printEntry(std::ostream& out, const std::string& name, const std::string& doc);

/// Prints a few lines for a user who gave no arguments.
void printUsage(std::ostream& out);

} // namespace command
