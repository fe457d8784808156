// SPDX-License-Identifier: Apache-2.0
/// @file VolHeader.h
/// @brief The text at the start of a `.vol` or `.longvol` file: lines `Key: value`, then a line `.`.
///
/// Strict: a header that asks for more than its file can hold is refused before memory is
/// allocated. A raw file holds its bytes; deflate expands no more than 1032 times.

#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <string>

namespace openvdb_spheretree::detail {

struct VolHeader {
    std::array<std::uint64_t, 3> dim{}; // X, Y, Z
    int version = 2;
    std::array<double, 3> voxelSize{1, 1, 1}; // world units along x, y, z
    std::uint64_t bytesPerValue = 1;
    std::uint64_t dataOffset = 0; // of the first byte after the header
    std::uint64_t dataBytes = 0;  // from there to the end of the file

    std::uint64_t sliceBytes() const { return dim[0] * dim[1] * bytesPerValue; }
    std::uint64_t volumeBytes() const { return sliceBytes() * dim[2]; }
};

/// @brief Read the header, and leave @a file where the values start.
/// @param path  whose extension says the format
/// @throw openvdb::IoError naming the key, not the file
/// @throw std::ios_base::failure if reading fails and @a file throws it
VolHeader readVolHeader(const std::string& path, std::ifstream& file, std::uint64_t fileBytes);

} // namespace openvdb_spheretree::detail
