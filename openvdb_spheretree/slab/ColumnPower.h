// SPDX-License-Identifier: Apache-2.0
/// @file slab/ColumnPower.h
/// @brief The last pass of the power map, along x, over some of the leaves of a run.

#pragma once

#include "../LeafLayout.h"
#include "../detail/LeafRows.h"
#include "../detail/MaxPlus.h"
#include "../detail/StepEnds.h"

#include <cstdint>
#include <cstring>
#include <vector>

namespace openvdb_spheretree {
namespace slab {

/// Leaves of a run along x whose keys are there, one behind the other, and which of them are to get
/// their labels: [first, last).
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

/// Memory of one thread; sees column after column.
template <typename Power>
class ColumnPower {
    using Key = typename Power::Key;
    using Offset = typename Power::Offset;

public:
    /// Finds the steps along x, marks where they lead, and calls visit(leaf, steps) for each leaf
    /// that gets them, with its 512.
    /// @param marks  one mask for each leaf of the layout, to be added to
    template <typename Visit>
    void run(
        const Column<Power>& column, const LeafLayout& layout, LeafMask* marks, const Visit& visit)
    {
        const int rows = int(column.count()) * kLeafDim;
        Key* keys = mKeys.rows(rows, 1);
        for (uint32_t i = 0; i < column.count(); ++i) {
            std::memcpy(
                keys + std::size_t(i) * kLeafVoxels, column.keys[i], kLeafVoxels * sizeof(Key));
        }
        Offset* steps = mSteps.rows(rows);
        const detail::RowRange wanted{
            int(column.first) * kLeafDim, int(column.last) * kLeafDim, rows};
        detail::maxPlus<Power>(keys, nullptr, steps, wanted, mEnvelope);
        mMarks.assign(column.count(), LeafMask{});
        const auto marksOf = [this](uint32_t i) -> LeafMask& { return mMarks[i]; };
        for (uint32_t i = column.first; i < column.last; ++i) {
            const Offset* own = steps + std::size_t(i) * kLeafVoxels;
            detail::markEnds(Axis::X, i, own, layout.mask(column.leaves[i]), marksOf);
            visit(column.leaves[i], own);
        }
        for (uint32_t i = 0; i < column.count(); ++i) {
            LeafMask& ofLeaf = marks[column.leaves[i]];
            for (int x = 0; x < kLeafDim; ++x) ofLeaf[x] |= mMarks[i][x];
        }
    }

private:
    detail::RowBuffer<Key> mKeys;
    detail::RowBuffer<Offset> mSteps;
    std::vector<LeafMask> mMarks; ///< of the column
    detail::EnvelopeScratch mEnvelope;
};

} // namespace slab
} // namespace openvdb_spheretree
