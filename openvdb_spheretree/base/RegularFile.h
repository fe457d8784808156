// SPDX-License-Identifier: Apache-2.0
/// @file RegularFile.h
/// @brief Opens a file that a reader takes from begin to end.

#pragma once

#include <fstream>
#include <string>

namespace openvdb_spheretree::detail {

/// @return the file, which throws std::ios_base::failure with the system's reason where reading fails.
/// @param name  what messages call the file
/// @param what  what it should be, for messages: "a file of spheres"
/// @throw openvdb::IoError if it is not there, empty, no regular file, or may not be read
std::ifstream openRegularFile(
    const std::string& path, const std::string& name, const std::string& what);

} // namespace openvdb_spheretree::detail
