// SPDX-License-Identifier: Apache-2.0
/// @file EnvelopeScratch.h
/// @brief Memory that the kernels of EnvelopeSearch-inl.h use again from run to run, one a thread.

#pragma once

#include "LeafRows.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

/// The rows [first, last) of @a count; all three are multiples of kLeafDim.
struct RowRange {
    int first, last, count;
};

/// An entry for each leaf of the run: its eight rows are decided together.
struct EnvelopeScratch {
    std::vector<int> reach;                 ///< how far away a better row can be
    std::vector<int64_t> largest, smallest; ///< values in the leaf; smallest of the object
    RowBuffer<int32_t> keys;                ///< rows in another form
    RowBuffer<int64_t> wideKeys;

    void resize(std::size_t leaves)
    {
        reach.resize(leaves);
        largest.resize(leaves);
        smallest.resize(leaves);
    }
};

} // namespace detail
} // namespace openvdb_spheretree
