// SPDX-License-Identifier: Apache-2.0
/// @file Picture.h
/// @brief A picture in memory, and as a .png or .jpg.

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

/// @return whether this build writes .jpg, because it has libjpeg.
bool writesJpeg();

/// @brief Write a .jpg of this quality, with colours at half the resolution as libjpeg has it. With the
/// same version of libjpeg, the same picture gives the same bytes.
/// @param quality  1 to 100
/// @throw openvdb::ValueError as above, or if the quality is out of range
/// @throw openvdb::IoError if the stream fails, or this build has no libjpeg
void writeJpeg(const Picture& picture, std::ostream& out, int quality = 90);

} // namespace openvdb_spheretree
