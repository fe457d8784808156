// SPDX-License-Identifier: Apache-2.0
#include "StreamWindow.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {
namespace slab {

int64_t slabBytes(
    const LeafLayout& layout, const StreamMemory& memory, uint32_t largestDistSq, uint32_t window)
{
    // A slab waits for those that its last voxels reach, and then for those that reach it.
    const auto reach = uint64_t(std::ceil(std::sqrt(double(largestDistSq))));
    const uint64_t open = window + 2 * (reach / kLeafDim + 2);
    const uint32_t slabs = layout.slabCount();
    int64_t most = 0;
    for (uint32_t first = 0; first < slabs; ++first) {
        const auto end = uint32_t(std::min<uint64_t>(slabs, first + open));
        const int64_t leaves = layout.slab(end - 1).end - layout.slab(first).begin;
        most = std::max(most, leaves);
    }
    return most * memory.perLeaf;
}

uint32_t windowWithin(
    const LeafLayout& layout, const StreamMemory& memory, uint32_t largestDistSq, int64_t bytes)
{
    constexpr double kGiB = 1 << 30;
    uint32_t window = std::max<uint32_t>(1, layout.slabCount());
    while (true) {
        const int64_t needed = memory.fixed + slabBytes(layout, memory, largestDistSq, window);
        if (needed <= bytes) return window;
        if (window == 1) {
            OPENVDB_THROW(openvdb::ValueError,
                "the object's " << layout.leafCount()
                                << " leaf nodes, those inside its tiles included, need about "
                                << std::ceil(double(needed) / kGiB * 10) / 10
                                << " GiB for their power labels, and there are "
                                << std::floor(double(bytes) / kGiB * 10) / 10
                                << ": use a larger voxel, or split the object");
        }
        window = window / 2;
    }
}

} // namespace slab
} // namespace openvdb_spheretree
