// SPDX-License-Identifier: Apache-2.0
#include "StreamWindow.h"

#include <openvdb/Exceptions.h>

#include <tbb/task_arena.h>

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

namespace {

/// More slabs at a time are no faster: memory that is used again is at hand, fresh pages take
/// longer than the passes (gyroid of 10^8 voxels: 26 Mvoxel/s with all slabs at once, 38 with few).
uint32_t usefulWindow(const LeafLayout& layout)
{
    constexpr uint32_t kLeaves = 8192, kSlabsOfThread = 4;
    const uint32_t slabs = std::max<uint32_t>(1, layout.slabCount());
    const auto threads = uint32_t(tbb::this_task_arena::max_concurrency());
    const uint32_t leavesOfSlab = std::max<uint32_t>(1, layout.leafCount() / slabs);
    return std::min(slabs, std::max(kSlabsOfThread * threads, kLeaves / leavesOfSlab));
}

} // namespace

uint32_t windowWithin(
    const LeafLayout& layout, const StreamMemory& memory, uint32_t largestDistSq, int64_t bytes)
{
    constexpr double kGiB = 1 << 30;
    uint32_t window = usefulWindow(layout);
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
