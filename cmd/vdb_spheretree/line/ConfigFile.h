// SPDX-License-Identifier: Apache-2.0
/// @file ConfigFile.h
/// @brief -config: actions from a file, one on each line, as in vdb_tool.
///
/// A line has an action and its options; dashes before its name may be left out. A `#` at the start
/// of a word begins a comment. Words are split at blanks, except within single or double quotes. The
/// first line may be `vdb_spheretree VERSION`.

#pragma once

#include <string>
#include <vector>

namespace command {

/// @return the words of the file, as if they had been typed.
/// @throw CommandError (input) if it cannot be read, holds a zero or more than 1 MiB, (usage) if a quote
///        is not closed
std::vector<std::string> readConfigFile(const std::string& path);

} // namespace command
