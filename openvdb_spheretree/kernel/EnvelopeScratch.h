// SPDX-License-Identifier: Apache-2.0
/// @file EnvelopeScratch.h
/// @brief Memory that the kernels of EnvelopeSearch-inl.h use again from run to run, one a thread.

#pragma once

#include "LeafRows.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// The rows [first, last) of `count`; all three are multiples of kLeafDim.
struct RowRange {
    int first, last, count;
};

struct EnvelopeScratch {
    std::vector<int> reach;                 ///< by leaf: how many rows away a better row can be
    std::vector<int64_t> largest, smallest; ///< by leaf: its values; smallest of object voxels
    RowBuffer<int32_t> keys;                ///< rows that a kernel made of its input
    RowBuffer<int64_t> wideKeys;            ///< the same

    void resize(std::size_t leaves)
    {
        reach.resize(leaves);
        largest.resize(leaves);
        smallest.resize(leaves);
    }
};

} // namespace openvdb_spheretree::detail
