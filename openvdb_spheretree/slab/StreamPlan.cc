// SPDX-License-Identifier: Apache-2.0
#include "StreamPlan.h"

#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/base/Memory.h>

#include <algorithm>

namespace openvdb_spheretree::slab {

namespace {

int64_t largestSlab(const LeafLayout& layout)
{
    int64_t most = 0;
    for (uint32_t slab = 0; slab < layout.slabCount(); ++slab) {
        most = std::max<int64_t>(most, layout.slab(slab).size());
    }
    return most;
}

/// More slabs at a time are no faster: fresh pages take longer than memory that is used again
/// (gyroid of 10^8 voxels: 26 Mvoxel/s with all slabs at once, 38 with few).
uint32_t usefulWindow(const LeafLayout& layout, uint32_t threads)
{
    constexpr uint32_t kLeaves = 8192, kSlabsOfThread = 4;
    const uint32_t slabs = std::max<uint32_t>(1, layout.slabCount());
    const uint32_t leavesOfSlab = std::max<uint32_t>(1, layout.leafCount() / slabs);
    return std::min(slabs, std::max(kSlabsOfThread * threads, kLeaves / leavesOfSlab));
}

/// What packed labels take at least.
struct PackedNeeds {
    PackedNeeds(const LeafLayout& layout, const StreamMemory& memory)
    {
        const int64_t leaves = largestSlab(layout);
        slab = leaves * (memory.scratch + memory.labels);
        // A thread packs a group of leaves, and compresses it.
        thread = slab + 2 * memory.packed * std::min<int64_t>(leaves, kGroupLeaves);
        int64_t longestRun = 0;
        for (uint32_t run = 0; run < layout.runCount(Axis::X); ++run) {
            longestRun = std::max<int64_t>(longestRun, layout.run(Axis::X, run).count);
        }
        band = std::max(memory.gaps, longestRun * memory.keys);
        all = memory.fixed + thread + band;
    }

    int64_t slab;   ///< that a thread works on
    int64_t thread; ///< all in all
    int64_t band;   ///< of keys, or the gaps along x before
    int64_t all;    ///< with one thread
};

/// Beside what each thread works on, compressed labels take what there is. When all slabs have
/// entered, the gaps along x and the threads' slabs make room for a band of keys.
StreamPlan packedPlan(
    const LeafLayout& layout, const StreamMemory& memory, int64_t bytes, uint32_t threads)
{
    const PackedNeeds needs(layout, memory);
    detail::requireAllowed(layout.leafCount(), needs.all, bytes);
    StreamPlan plan;
    plan.packed = true;
    const int64_t more = std::min<int64_t>((bytes - needs.all) / needs.thread, threads - 1);
    plan.slabs = uint32_t(std::min<int64_t>(1 + more, layout.slabCount()));
    plan.threads = plan.slabs;
    plan.packedBytes = int64_t(layout.leafCount()) * memory.packed;
    const int64_t uncounted = bytes / 16; // rows of runs, what allocations take beside their bytes
    const int64_t taken = needs.all + (plan.slabs - 1) * needs.thread + uncounted;
    plan.storedBytes = std::max<int64_t>(0, bytes - taken);
    plan.bandBytes = needs.band + (plan.slabs - 1) * needs.slab;
    plan.bytes = bytes;
    return plan;
}

} // namespace

int64_t windowBytes(
    const LeafLayout& layout, const StreamMemory& memory, uint32_t largestDistSq, uint32_t window)
{
    // A slab waits for those that its last voxels reach, and then for those that reach it.
    const auto reach = uint64_t(detail::ceilSqrt(largestDistSq));
    const uint64_t open = window + 2 * (reach / kLeafDim + 2);
    const uint32_t slabs = layout.slabCount();
    int64_t most = 0; // leaves
    for (uint32_t first = 0; first < slabs; ++first) {
        const auto end = uint32_t(std::min<uint64_t>(slabs, first + open));
        most = std::max<int64_t>(most, layout.slab(end - 1).end - layout.slab(first).begin);
    }
    return most * memory.labels;
}

StreamPlan planWithin(const LeafLayout& layout, const StreamMemory& memory, uint32_t largestDistSq,
    int64_t bytes, uint32_t threads)
{
    const int64_t scratch = largestSlab(layout) * memory.scratch;
    StreamPlan plan;
    for (plan.slabs = usefulWindow(layout, threads); plan.slabs > 0; plan.slabs /= 2) {
        plan.threads = std::min(threads, plan.slabs);
        plan.bytes = memory.fixed + memory.gaps + plan.threads * scratch
            + windowBytes(layout, memory, largestDistSq, plan.slabs);
        if (plan.bytes <= bytes) return plan;
    }
    return packedPlan(layout, memory, bytes, threads);
}

int64_t leastBytes(const LeafLayout& layout, const StreamMemory& memory)
{
    return PackedNeeds(layout, memory).all;
}

LeafGroups::LeafGroups(const LeafLayout& layout, int64_t keyBytes, int64_t bandBytes)
    : ofSlab(layout.slabCount())
{
    std::vector<uint32_t> next(layout.slabCount()); // of a slab, the leaves in no band so far
    for (uint32_t slab = 0; slab < layout.slabCount(); ++slab) next[slab] = layout.slab(slab).begin;
    std::vector<uint32_t> end = next;
    const auto closeBand = [&] {
        for (uint32_t slab = 0; slab < layout.slabCount(); ++slab) {
            while (next[slab] < end[slab]) {
                const uint32_t begin = next[slab];
                next[slab] = std::min(end[slab], begin + kGroupLeaves);
                ofSlab[slab].push_back(uint32_t(groups.size()));
                groups.push_back({slab, begin, next[slab]});
            }
        }
    };
    int64_t bytes = 0;
    for (uint32_t i = 0; i < layout.runCount(Axis::X); ++i) {
        const LeafLayout::Run run = layout.run(Axis::X, i);
        const int64_t ofRun = run.count * keyBytes;
        if (i == 0 || bytes + ofRun > bandBytes) {
            closeBand();
            bytes = 0;
            firstRunOfBand.push_back(i);
            firstOfBand.push_back(uint32_t(groups.size()));
        }
        bytes += ofRun;
        const uint32_t first = layout.slabOf(run.leaves[0]);
        for (uint32_t k = 0; k < run.count; ++k) ++end[first + k];
    }
    closeBand();
    firstRunOfBand.push_back(layout.runCount(Axis::X));
    firstOfBand.push_back(uint32_t(groups.size()));
}

} // namespace openvdb_spheretree::slab
