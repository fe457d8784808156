// SPDX-License-Identifier: Apache-2.0
/// @file Picture.h
/// @brief A picture in memory, and as a .png.

#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

namespace openvdb_spheretree {

struct Picture {
    int width = 0, height = 0; ///< pixels
    std::vector<uint8_t> rgb;  ///< sRGB, three bytes for a pixel, rows from the top, no padding
};

/// @brief Write a .png with 8 bits for a channel, marked as sRGB. With the same versions of libpng
/// and zlib, the same picture gives the same bytes.
/// @throw openvdb::ValueError if the picture is empty, or does not have width x height x 3 bytes
/// @throw openvdb::IoError if the stream fails
void writePng(const Picture& picture, std::ostream& out);

} // namespace openvdb_spheretree
