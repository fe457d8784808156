// SPDX-License-Identifier: Apache-2.0
/// @file SlabPower.h
/// @brief The passes of the power map that stay within a slab: along z, then along y.
///
/// Every voxel starts as its own site. Rows of distances come from SlabDistance.h as they are made;
/// keys go from rows along z to rows along y without a stop in leaf order.

#pragma once

#include "SlabLabels.h"
#include "SlabRows.h"
#include <openvdb_spheretree/kernel/LeafRows.h>
#include <openvdb_spheretree/kernel/LeafTranspose.h>
#include <openvdb_spheretree/kernel/MaxPlus.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <hwy/cache_control.h>

#include <cstdint>

namespace openvdb_spheretree::slab {

/// Memory of one thread, for one slab after the other. Calls: open(), alongZ() for each run along
/// z, alongY(). In two dimensions: open(), fromY() for each run along y.
template <typename Power>
class SlabPower {
    using Key = typename Power::Key;
    using Offset = typename Power::Offset;

public:
    void open(const LeafLayout& layout, uint32_t slab, int dim)
    {
        if (dim == 3) mAlongY.open(layout, slab, Axis::Y);
    }

    /// @param distances  of a run along z, as rows
    /// @return the largest of them.
    template <typename T>
    uint32_t alongZ(const LeafLayout::Run& run, const T* distances, const SlabLabels<Power>& labels)
    {
        const uint32_t largest = first(run, distances);
        for (uint32_t i = 0; i < run.count; ++i) {
            const std::size_t place = std::size_t(i) * kLeafVoxels;
            detail::rowsZToLeaf(mOffsets + place, labels.dzOf(run.leaves[i]));
            detail::swapRows(mBest + place, mAlongY.ofLeaf(run.leaves[i]));
        }
        return largest;
    }

    void alongY(const LeafLayout& layout, uint32_t slab, const SlabLabels<Power>& labels)
    {
        const LeafLayout::Slab runs = layout.runsOfSlab(Axis::Y, slab);
        for (uint32_t index = runs.begin; index < runs.end; ++index) {
            const LeafLayout::Run run = layout.run(Axis::Y, index);
            const int rows = open(run);
            detail::maxPlus<Power>(
                mAlongY.ofRun(index), mBest, mOffsets, {0, rows, rows}, mEnvelope);
            store(run, labels);
        }
        hwy::FlushStream(); // what went past the cache is there for other threads
    }

    /// @param distances  of a run along y, as rows
    /// @return the largest of them.
    template <typename T>
    uint32_t fromY(const LeafLayout::Run& run, const T* distances, const SlabLabels<Power>& labels)
    {
        const uint32_t largest = first(run, distances);
        store(run, labels);
        hwy::FlushStream();
        return largest;
    }

private:
    int open(const LeafLayout::Run& run)
    {
        const int rows = int(run.count) * kLeafDim;
        mBest = mKeyRows.rows(rows);
        mOffsets = mOffsetRows.rows(rows);
        return rows;
    }

    template <typename T>
    uint32_t first(const LeafLayout::Run& run, const T* distances)
    {
        const int rows = open(run);
        return detail::firstMaxPlus<Power>(distances, mBest, mOffsets, rows, mEnvelope);
    }

    /// The result of a run along y.
    void store(const LeafLayout::Run& run, const SlabLabels<Power>& labels) const
    {
        for (uint32_t i = 0; i < run.count; ++i) {
            const std::size_t place = std::size_t(i) * kLeafVoxels;
            detail::streamRowsYToLeaf(mBest + place, labels.keysOf(run.leaves[i]));
            detail::rowsToLeaf(Axis::Y, mOffsets + place, labels.dyOf(run.leaves[i]));
        }
    }

    SlabRows<Key> mAlongY;
    detail::RowBuffer<Key> mKeyRows;
    detail::RowBuffer<Offset> mOffsetRows;
    Key* mBest = nullptr;       ///< of the run at hand, as rows
    Offset* mOffsets = nullptr; ///< the same
    detail::EnvelopeScratch mEnvelope;
};

} // namespace openvdb_spheretree::slab
