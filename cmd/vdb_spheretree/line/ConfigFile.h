// SPDX-License-Identifier: Apache-2.0
/// @file ConfigFile.h
/// @brief -config: actions from a file, one on each line, as in vdb_tool.
///
/// A line has an action and its options; dashes before its name may be left out. A `#` at the start
/// of a word begins a comment. Words are split at blanks, except within single or double quotes. A
/// `\` at the end of a line, outside of comments, has the next one go on with it. The first line may
/// be `vdb_spheretree VERSION`, or `vdb_tool VERSION`, as vdb_tool writes it. A byte order mark of
/// UTF-8 before it is skipped.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace command {

/// The words of a line and of those that go on with it, as if they had been typed.
struct ConfigLine {
    int number; ///< of the first of them, from 1
    std::vector<std::string> words;
};

/// @return the lines of the file that have words.
/// @param bytesInAll  of all files of the command line so far, each as often as it is read, and as
///                    1 KiB at least; this one is added. Files that name each other in a chain could
///                    multiply without end
/// @throw Interrupted, CommandError (input) if it cannot be read, holds a zero or more than 1 MiB,
///        (usage) if a quote is not closed, or all files hold more than 4 MiB
std::vector<ConfigLine> readConfigFile(const std::string& path, size_t& bytesInAll);

} // namespace command
