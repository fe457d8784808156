// SPDX-License-Identifier: Apache-2.0
/// @file UnnamedFile.h
/// @brief A temporary file without a name: whatever ends the program, nothing that it holds is left.
///
/// By O_TMPFILE, where the file system has it (Linux; not network file systems), it never had a name.
/// Elsewhere it loses the one it was made with at once, and a SIGKILL just between the two calls
/// leaves an empty file, `spheretree.XXXXXX`.

#pragma once

#include <string>

namespace openvdb_spheretree::detail {

/// @return $TMPDIR, or /tmp where that is not set.
std::string temporaryFolder();

/// @return a descriptor to read and write an empty file of its owner's alone in that folder; -1, and errno, if none
///         can be made.
int openUnnamedFile(const std::string& folder);

} // namespace openvdb_spheretree::detail
