// SPDX-License-Identifier: Apache-2.0
/// @file LeafFinder.h
/// @brief Finds the leaves of voxels that come nearly in the order of coordinates, as the centers
/// of a level's balls do. The slab and the row of leaves of the last voxel are looked at first.

#pragma once

#include "LeafLayout.h"

#include <cstdint>
#include <optional>

namespace openvdb_spheretree::detail {

/// Memory of one thread.
class LeafFinder {
public:
    /// @param layout  kept by reference
    explicit LeafFinder(const LeafLayout& layout) : mLayout(layout) {}

    /// @return what LeafLayout::findLeaf() does.
    std::optional<uint32_t> find(const openvdb::Coord& ijk)
    {
        const openvdb::Coord origin = ijk & ~7;
        if (mSlab.size() == 0 || mLayout.origin(mSlab.begin)[0] != origin[0]) {
            mSlab = having({0, mLayout.leafCount()}, 0, origin[0]);
            mRow = {0, 0};
        }
        if (mRow.size() == 0 || mLayout.origin(mRow.begin)[1] != origin[1]) {
            mRow = having(mSlab, 1, origin[1]);
        }
        if (mRow.size() == 0) return std::nullopt;
        if (mLast < mRow.begin || mLast >= mRow.end || mLayout.origin(mLast)[2] > origin[2])
            mLast = mRow.begin;
        mLast = first({mLast, mRow.end}, 2, origin[2]);
        if (mLast == mRow.end || mLayout.origin(mLast)[2] != origin[2]) return std::nullopt;
        return mLast;
    }

private:
    using Leaves = LeafLayout::Slab; ///< [begin, end)

    /// @return the first of @a leaves at @a coordinate or behind; it is often the very first.
    uint32_t first(Leaves leaves, int axis, int32_t coordinate) const
    {
        if (leaves.size() == 0 || mLayout.origin(leaves.begin)[axis] >= coordinate)
            return leaves.begin;
        while (leaves.size() > 1) { // the begin is always before
            const uint32_t middle = leaves.begin + leaves.size() / 2;
            (mLayout.origin(middle)[axis] < coordinate ? leaves.begin : leaves.end) = middle;
        }
        return leaves.end;
    }
    /// @return the leaves among these that have a coordinate.
    Leaves having(Leaves leaves, int axis, int32_t coordinate) const
    {
        const uint32_t begin = first(leaves, axis, coordinate);
        return {begin, first({begin, leaves.end}, axis, coordinate + 1)};
    }

    const LeafLayout& mLayout;
    Leaves mSlab{0, 0}, mRow{0, 0};
    uint32_t mLast = 0;
};

} // namespace openvdb_spheretree::detail
