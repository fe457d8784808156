// SPDX-License-Identifier: Apache-2.0
/// @file ConfigFile.h
/// @brief -config: actions from a file, one a line, as vdb_tool has them.
///
/// A line is an action and its options, with or without dashes before its name. What follows a `#`
/// at the start of a word is a comment. Words are split at blanks; quotes, single or double, keep
/// blanks. A first line `vdb_spheretree VERSION` is allowed.

#pragma once

#include <string>
#include <vector>

namespace command {

/// @return the file's tokens, as if they had been typed.
/// @throw CommandError (input) if it cannot be read, (usage) if a quote is not closed
std::vector<std::string> readConfigFile(const std::string& path);

} // namespace command
