// SPDX-License-Identifier: Apache-2.0
/// @file detail/LaneBits.h
/// @brief Comparisons of 64 values at once, as the bits of a word.

#pragma once

#include <cstdint>
#include <cstring>

namespace openvdb_spheretree {
namespace detail {

/// The first of each eight voxels along z.
constexpr uint64_t kFirstAlongZ = 0x0101010101010101;

/// @return bit i: a[i] == b[i]. Compilers make vector code of the first loop; the second packs
/// eight bytes of 0 or 1 by a product, whose top byte is the sum of shifts that has them as bits.
inline uint64_t equalLanes(const int32_t* a, const int32_t* b)
{
    alignas(64) uint8_t equal[64];
    for (int lane = 0; lane < 64; ++lane) equal[lane] = a[lane] == b[lane];
    uint64_t bits = 0;
    for (int byte = 0; byte < 8; ++byte) {
        uint64_t eight;
        std::memcpy(&eight, equal + 8 * byte, 8);
        bits |= (eight * 0x0102040810204080u >> 56) << 8 * byte;
    }
    return bits;
}

} // namespace detail
} // namespace openvdb_spheretree
