// SPDX-License-Identifier: Apache-2.0
/// @file ArrayLayout.h
/// @brief How the numbers of a volume stand in a file: how many, of what type, in what order.

#pragma once

#include "NumberType.h"

#include <array>
#include <cstdint>
#include <string>

namespace openvdb_spheretree::detail {

struct ArrayLayout {
    std::array<uint64_t, 3> dim{1, 1, 1}; ///< numbers along x, y, z
    std::array<int, 3> order{0, 1, 2};    ///< the axes, that of neighbours in the file first
    NumberType type = NumberType::UInt8;
    bool bigEndian = false;
    /// A number n stands for slope n + intercept; then the grid is one of floats.
    double slope = 1, intercept = 0;

    bool isScaled() const { return slope != 1 || intercept != 0; }
    int slow() const { return order[2]; }
    uint64_t sliceNumbers() const { return dim[order[0]] * dim[order[1]]; }
    /// Of one step along the slowest axis.
    uint64_t sliceBytes() const { return sliceNumbers() * uint64_t(bytesOf(type)); }
    uint64_t bytes() const { return sliceBytes() * dim[slow()]; }

    /// A side may have so many numbers: all bytes of an array are below 2^64 then.
    static constexpr uint64_t kMaxSide = 1 << 20;
};

/// Refuses sides that are 0 or larger than kMaxSide.
/// @throw openvdb::IoError without the name of a file
void requireSides(const ArrayLayout& layout);

/// Refuses a file that cannot hold the array, before memory is taken for it. Nothing may follow it.
/// @param held     bytes of the file behind its header
/// @param deflated whether they are compressed: then 1032 times as many may come of them, as zlib
///                 documents
/// @throw openvdb::IoError without the name of a file
void requireHeld(const ArrayLayout& layout, uint64_t held, bool deflated);

/// @return `X x Y x Z numbers of type uint8`, for messages.
std::string describe(const ArrayLayout& layout);

} // namespace openvdb_spheretree::detail
