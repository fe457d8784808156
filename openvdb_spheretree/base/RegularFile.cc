// SPDX-License-Identifier: Apache-2.0
#include "RegularFile.h"

#include <openvdb/Exceptions.h>

#include <filesystem>
#include <system_error>

namespace openvdb_spheretree::detail {

std::ifstream openRegularFile(
    const std::string& path, const std::string& name, const std::string& what)
{
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    std::string why;
    if (!std::filesystem::exists(status)) why = "no such file";
    else if (std::filesystem::is_directory(status)) why = "is a directory, not " + what;
    else if (!std::filesystem::is_regular_file(status)) why = "is not a regular file";
    else if (std::filesystem::file_size(path, error) == 0) why = "the file is empty";
    if (!why.empty()) throw openvdb::IoError(name + ": " + why);
    std::ifstream file(path, std::ios::binary);
    if (!file) throw openvdb::IoError(name + ": cannot be opened for reading");
    file.exceptions(std::ios::badbit); // a reading that fails is no end of the file
    return file;
}

} // namespace openvdb_spheretree::detail
