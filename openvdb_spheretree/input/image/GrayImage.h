// SPDX-License-Identifier: Apache-2.0
/// @file GrayImage.h
/// @brief A picture as rows of gray: `.png` and `.pgm`, of 8 or 16 bits.
///
/// Values are taken as they are stored: gamma and color spaces do not count, and 1, 2 or 4 bits stay
/// the small numbers that they are. Colors, and palettes, are read where every pixel is gray. (Masks
/// are often stored so. A luminance of colors would be a guess: labels drawn in color would become
/// other numbers.) The picture must be opaque.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

struct GrayImage {
    uint64_t width = 0, height = 0;
    int bytesPerPixel = 1;       ///< 1 or 2
    std::vector<uint8_t> pixels; ///< rows from the top; two bytes in the order of this machine

    uint64_t bytes() const { return width * height * uint64_t(bytesPerPixel); }
};

/// @return whether the name ends with `.png` or `.pgm`, in any case.
bool isImageFileName(const std::string& path);

/// @return the picture.
/// @param shownAs  whose extension says the format
/// @throw openvdb::IoError without the name of the file if it cannot be read, is damaged, or has
///        colors; std::bad_alloc
GrayImage readGrayImage(const std::string& path, const std::string& shownAs);

/// @name The same of the bytes of a file
/// @{
GrayImage readPng(const std::vector<uint8_t>& file);
GrayImage readPgm(const std::vector<uint8_t>& file);
/// @}

/// Sides of a picture: 1 to 2^20.
constexpr uint64_t kMaxImageSide = 1 << 20;

} // namespace openvdb_spheretree::detail
