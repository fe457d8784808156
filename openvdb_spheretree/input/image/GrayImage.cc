// SPDX-License-Identifier: Apache-2.0
#include "GrayImage.h"

#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <filesystem>
#include <fstream>
#include <ios>
#include <system_error>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::IoError;

std::vector<uint8_t> bytesOfFile(const std::string& path)
{
    std::error_code error;
    if (!std::filesystem::exists(path, error)) throw IoError("no such file");
    if (!std::filesystem::is_regular_file(path, error)) throw IoError("is not a regular file");
    const uint64_t size = std::filesystem::file_size(path, error);
    std::ifstream file(path, std::ios::binary);
    if (error || !file) throw IoError("cannot be opened for reading");
    std::vector<uint8_t> bytes(size);
    file.exceptions(std::ios::badbit);
    try {
        file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size));
    } catch (const std::ios_base::failure& failure) {
        throw IoError("cannot be read: " + failure.code().message());
    }
    bytes.resize(std::size_t(file.gcount()));
    return bytes;
}

} // namespace

bool isImageFileName(const std::string& path)
{
    const std::string extension = lowerExtension(path);
    return extension == ".png" || extension == ".pgm";
}

GrayImage readGrayImage(const std::string& path, const std::string& shownAs)
{
    const std::vector<uint8_t> file = bytesOfFile(path);
    return lowerExtension(shownAs) == ".pgm" ? readPgm(file) : readPng(file);
}

} // namespace openvdb_spheretree::detail
