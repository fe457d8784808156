// SPDX-License-Identifier: Apache-2.0
/// @file StreamPlan.h
/// @brief How a stream of labels keeps to its bound on memory, planned before it starts.

#pragma once

#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::slab {

/// What a stream takes, in bytes.
struct StreamMemory {
    int64_t fixed;   ///< whatever the plan: layout, masks, queries, offsets that are kept
    int64_t gaps;    ///< along x, of all leaves, while slabs enter
    int64_t scratch; ///< per leaf of a slab that a thread works on
    int64_t labels;  ///< per leaf of a slab in memory
    int64_t keys;    ///< per leaf whose keys alone are in memory
    int64_t packed;  ///< per leaf of packed labels, before they are compressed
};

struct StreamPlan {
    bool packed = false;           ///< PackedStream.h; else WindowStream.h
    uint32_t slabs = 1;            ///< that enter at a time; packed: that are worked on at a time
    uint32_t threads = 1;          ///< that work on slabs
    int64_t packedBytes = 0;       ///< packed: of all labels, before they are compressed
    int64_t storedBytes = 0;       ///< packed: of compressed labels in memory
    int64_t bandBytes = INT64_MAX; ///< packed: of keys that are unpacked for the pass along x
    int64_t bytes = 0;             ///< at most, all in all
};

/// Packed labels are compressed so many leaves at a time, or fewer: 2 or 4 MiB.
constexpr uint32_t kGroupLeaves = 1024;

/// @param largestDistSq  no ball has a larger squared radius
/// @return the most bytes that slabs take at a time if @a window of them enter together.
int64_t windowBytes(
    const LeafLayout& layout, const StreamMemory& memory, uint32_t largestDistSq, uint32_t window);

/// @param bytes  that the stream may take
/// @return a window of as many slabs as keep the threads busy. If it does not fit, half as many
///         slabs, a quarter, and so on; if not even one slab fits, packed labels, on as many of @a
///         threads as fit.
/// @throw detail::MemoryError if nothing fits
StreamPlan planWithin(const LeafLayout& layout, const StreamMemory& memory, uint32_t largestDistSq,
    int64_t bytes, uint32_t threads);

/// @return the fewest bytes with which planWithin() plans packed labels. With as many it never throws.
int64_t leastBytes(const LeafLayout& layout, const StreamMemory& memory);

/// Leaves of a slab, [begin, end), that are packed together.
struct LeafGroup {
    uint32_t slab, begin, end;
};

/// @brief How slabs are cut into groups of leaves.
///
/// A *band* is a range of runs along x in the order of y, then z. Leaves of a slab have the same
/// order, so those of a band are a range too. It is cut into groups, and the runs of a band need
/// the groups of the band and no others.
struct LeafGroups {
    /// @param bandBytes  of keys that a band may have; a single run may have more
    LeafGroups(const LeafLayout& layout, int64_t keyBytes, int64_t bandBytes);

    std::vector<LeafGroup> groups;             ///< by band
    std::vector<uint32_t> firstOfBand;         ///< of the groups; their number at the end
    std::vector<uint32_t> firstRunOfBand;      ///< the same of runs along x
    std::vector<std::vector<uint32_t>> ofSlab; ///< the groups of each slab
};

} // namespace openvdb_spheretree::slab
