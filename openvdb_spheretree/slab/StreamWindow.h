// SPDX-License-Identifier: Apache-2.0
/// @file slab/StreamWindow.h
/// @brief How many slabs may enter a stream of labels at a time, so that its memory stays within
/// bounds.

#pragma once

#include "../LeafLayout.h"

#include <cstdint>

namespace openvdb_spheretree {
namespace slab {

/// What a stream takes, in bytes.
struct StreamMemory {
    int64_t perLeaf; ///< of slabs in memory
    int64_t fixed;   ///< whatever the window: steps along x, masks
};

/// @param largestDistSq  no ball has a larger squared radius
/// @return the most bytes that slabs take at a time when @a window of them enter together.
int64_t slabBytes(
    const LeafLayout& layout, const StreamMemory& memory, uint32_t largestDistSq, uint32_t window);

/// @return enough slabs to keep all threads busy, or the most of half as many, a quarter, ... that
/// fit.
/// @throw openvdb::ValueError if even one at a time does not
uint32_t windowWithin(
    const LeafLayout& layout, const StreamMemory& memory, uint32_t largestDistSq, int64_t bytes);

} // namespace slab
} // namespace openvdb_spheretree
