// SPDX-License-Identifier: Apache-2.0
/// @file ColumnPower.h
/// @brief The last pass of the power map, along x, over some of the leaves of a run.

#pragma once

#include <openvdb_spheretree/kernel/OffsetBits.h>
#include <openvdb_spheretree/kernel/LeafRows.h>
#include <openvdb_spheretree/kernel/MaxPlus.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace openvdb_spheretree::slab {

/// Leaves of a run along x with their keys, one behind the other. Those in [first, last) get their
/// labels. Leaves of the run may be left out at both ends if no ball of theirs reaches these. The
/// zero rows in their place are no background, but no harm: as candidates they are below 0, and
/// every voxel of the object has at least 1 by itself.
template <typename Power>
struct Column {
    std::vector<uint32_t> leaves;
    std::vector<const typename Power::Key*> keys; ///< 512 of each
    uint32_t first = 0, last = 0;

    void clear()
    {
        leaves.clear();
        keys.clear();
    }
    void add(uint32_t leaf, const typename Power::Key* keysOfLeaf)
    {
        leaves.push_back(leaf);
        keys.push_back(keysOfLeaf);
    }
    uint32_t count() const { return uint32_t(leaves.size()); }
};

/// A column, and memory of one thread for one after the other.
template <typename Power>
class ColumnPower {
    using Key = typename Power::Key;
    using Offset = typename Power::Offset;

public:
    Column<Power> column;

    /// Finds the column's offsets along x, marks their targets, and calls visit(leaf, offsets) for each leaf
    /// that gets its labels, with its 512.
    /// @param marks  a mask for each leaf of the layout, to be added to
    template <typename Visit>
    void run(const LeafLayout& layout, LeafMask* marks, const Visit& visit)
    {
        const int rows = int(column.count()) * kLeafDim;
        Key* keys = mKeys.rows(rows, 1);
        for (uint32_t i = 0; i < column.count(); ++i) {
            std::memcpy(
                keys + std::size_t(i) * kLeafVoxels, column.keys[i], kLeafVoxels * sizeof(Key));
        }
        Offset* offsets = mOffsets.rows(rows);
        const detail::RowRange range{
            int(column.first) * kLeafDim, int(column.last) * kLeafDim, rows};
        detail::maxPlus<Power>(keys, nullptr, offsets, range, mEnvelope);
        mOn.resize(std::size_t(rows));
        for (uint32_t i = column.first; i < column.last; ++i) {
            const LeafMask& mask = layout.mask(column.leaves[i]);
            std::copy(mask.begin(), mask.end(), mOn.begin() + std::ptrdiff_t(i) * kLeafDim);
            visit(column.leaves[i], offsets + std::size_t(i) * kLeafVoxels);
        }
        mMarks.assign(std::size_t(rows), 0);
        detail::markRowTargets(offsets + detail::at(range.first, 0), mOn.data() + range.first,
            range.last - range.first, mMarks.data() + range.first);
        for (uint32_t i = 0; i < column.count(); ++i) {
            LeafMask& ofLeaf = marks[column.leaves[i]];
            for (int x = 0; x < kLeafDim; ++x) ofLeaf[x] |= mMarks[std::size_t(i) * kLeafDim + x];
        }
    }

private:
    detail::RowBuffer<Key> mKeys;
    detail::RowBuffer<Offset> mOffsets;
    std::vector<uint64_t> mOn, mMarks; ///< of the column, a word a row
    detail::EnvelopeScratch mEnvelope;
};

} // namespace openvdb_spheretree::slab
