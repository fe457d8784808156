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

constexpr int kBlockRows = 8; ///< rows whose reach is decided together

/// The rows [first, last) of @a count; all are multiples of kBlockRows.
struct RowRange {
    int first, last, count;
};

/// One entry a block of rows.
struct EnvelopeScratch {
    std::vector<int> reach;                 ///< how far away a better row can be
    std::vector<int64_t> largest, smallest; ///< values in the block
    RowBuffer<int32_t> keys;                ///< rows in another form
    RowBuffer<int64_t> wideKeys;

    void resize(std::size_t blocks)
    {
        reach.resize(blocks);
        largest.resize(blocks);
        smallest.resize(blocks);
    }
};

} // namespace detail
} // namespace openvdb_spheretree
