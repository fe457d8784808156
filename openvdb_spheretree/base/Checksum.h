// SPDX-License-Identifier: Apache-2.0
/// @file Checksum.h
/// @brief The CRC-32 of numbers in an order of theirs: that of zlib, PNG and Ethernet.
///
/// It finds every single flipped bit, and any damage within 32 bits one after the other; of other damage
/// all but one in 2^32. Blocks are summed by all threads and joined in their order (zlib's
/// crc32_combine), which gives what one long run gives. Sums are by libdeflate where the library was
/// built with it (8 GB a second and thread), and by zlib otherwise (3 GB): the same numbers.

#pragma once

#include "Parallel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace openvdb_spheretree::detail {

/// @return the CRC-32 of what has the CRC-32 @a before, and @a data after it. Of nothing it is 0.
uint32_t extendedCrc32(uint32_t before, const void* data, std::size_t bytes);

/// @return the CRC-32 of blocks one after the other.
/// @param blocks  the CRC-32 of each: of @a blockBytes bytes, the last of @a lastBytes
uint32_t joinedCrc32(
    const std::vector<uint32_t>& blocks, std::size_t blockBytes, std::size_t lastBytes);

/// @param interrupter  may be null
/// @throw Interrupted
/// @return the CRC-32 of value(0), value(1), ... value(count - 1) as values of @a T, which has no
///         gaps between its members, in the machine's byte order: little-endian, as that of .vdb
///         files.
template <typename T, typename Value>
uint32_t crc32Of(std::size_t count, openvdb::util::NullInterrupter* interrupter, const Value& value)
{
    static_assert(std::is_trivially_copyable_v<T>);
    constexpr std::size_t kRun = 512, kBlock = 16 * kRun; // values
    std::vector<uint32_t> blocks((count + kBlock - 1) / kBlock, 0);
    parallelFor(blocks.size(), interrupter, [&](std::size_t block) {
        const std::size_t end = std::min(count, (block + 1) * kBlock);
        std::array<T, kRun> run;
        for (std::size_t begin = block * kBlock; begin < end; begin += kRun) {
            const std::size_t size = std::min(kRun, end - begin);
            for (std::size_t i = 0; i < size; ++i) run[i] = value(begin + i);
            blocks[block] = extendedCrc32(blocks[block], run.data(), size * sizeof(T));
        }
    });
    const std::size_t last = count - (blocks.empty() ? 0 : (blocks.size() - 1) * kBlock);
    return joinedCrc32(blocks, kBlock * sizeof(T), last * sizeof(T));
}

} // namespace openvdb_spheretree::detail
