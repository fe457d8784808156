// SPDX-License-Identifier: Apache-2.0
/// @file Help.h
/// @brief The texts that explain the command, made from the table of actions.

#pragma once

#include <iosfwd>

namespace command {

/// Prints a few lines for a user who gave no arguments.
void printUsage(std::ostream& out);

} // namespace command
