// SPDX-License-Identifier: Apache-2.0
#include "Checksum.h"

#ifdef SPHERETREE_WITH_LIBDEFLATE
#include <libdeflate.h>
#endif
#include <zlib.h>

namespace openvdb_spheretree::detail {

uint32_t extendedCrc32(uint32_t before, const void* data, std::size_t bytes)
{
#ifdef SPHERETREE_WITH_LIBDEFLATE
    return libdeflate_crc32(before, data, bytes);
#else
    return uint32_t(crc32_z(before, static_cast<const Bytef*>(data), bytes));
#endif
}

uint32_t joinedCrc32(
    const std::vector<uint32_t>& blocks, std::size_t blockBytes, std::size_t lastBytes)
{
    uint32_t joined = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const std::size_t bytes = i + 1 == blocks.size() ? lastBytes : blockBytes;
        joined = uint32_t(crc32_combine(joined, blocks[i], z_off_t(bytes)));
    }
    return joined;
}

} // namespace openvdb_spheretree::detail
