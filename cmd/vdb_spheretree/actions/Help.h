// SPDX-License-Identifier: Apache-2.0
/// @file Help.h
/// @brief The texts that explain the command, made from the table of actions.

#pragma once

#include <iosfwd>

namespace command {

/// A few lines, for somebody who typed nothing.
void printUsage(std::ostream& out);

} // namespace command
