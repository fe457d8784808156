// SPDX-License-Identifier: Apache-2.0
/// @file SlabRows.h
/// @brief The rows of all runs of a slab along one axis, one run behind the other, with a row of
/// zeros before and after each: background cuts runs by itself.

#pragma once

#include <openvdb_spheretree/kernel/LeafRows.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace openvdb_spheretree::slab {

template <typename T>
class SlabRows {
public:
    /// Makes room for the runs along @a axis, y or z. The rows of leaves are undefined.
    void open(const LeafLayout& layout, uint32_t slab, Axis axis)
    {
        const LeafLayout::Slab leaves = layout.slab(slab), runs = layout.runsOfSlab(axis, slab);
        mFirstLeaf = leaves.begin;
        mFirstRun = runs.begin;
        mLeafRow.resize(leaves.size());
        mRunRow.resize(runs.size());
        mFirst = mRows.rows(std::size_t(leaves.size()) * kLeafDim + runs.size(), 1);
        uint32_t row = 0;
        for (uint32_t run = runs.begin; run < runs.end; ++run) {
            const LeafLayout::Run here = layout.run(axis, run);
            mRunRow[run - mFirstRun] = row;
            for (uint32_t i = 0; i < here.count; ++i, row += kLeafDim) {
                mLeafRow[here.leaves[i] - mFirstLeaf] = row;
            }
            std::memset(at(row++), 0, detail::kLanes * sizeof(T));
        }
    }

    /// The eight rows of a leaf.
    T* ofLeaf(uint32_t leaf) { return at(mLeafRow[leaf - mFirstLeaf]); }
    /// All rows of a run.
    T* ofRun(uint32_t run) { return at(mRunRow[run - mFirstRun]); }

private:
    T* at(uint32_t row) { return mFirst + std::size_t(row) * detail::kLanes; }

    detail::RowBuffer<T> mRows;
    T* mFirst = nullptr;
    uint32_t mFirstLeaf = 0, mFirstRun = 0;
    std::vector<uint32_t> mLeafRow, mRunRow;
};

} // namespace openvdb_spheretree::slab
