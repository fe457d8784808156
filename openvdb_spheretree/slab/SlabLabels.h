// SPDX-License-Identifier: Apache-2.0
/// @file SlabLabels.h
/// @brief The power labels of a slab in memory, while balls of other slabs may still reach it; and those
/// of all slabs, as they are kept.

#pragma once

#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/VoxelRef.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// Offsets along one axis, 512 a leaf; one of the arrays is null, both if the axis takes no part.
struct AxisOffsets {
    LargeArray<int8_t> narrow;
    LargeArray<int16_t> wide;

    bool empty() const { return !narrow && !wide; }
    /// Makes room for @a size offsets. @return where they go.
    template <typename Offset>
    Offset* make(std::size_t size)
    {
        if constexpr (sizeof(Offset) == 1) return (narrow = makeLargeArray<int8_t>(size)).get();
        else return (wide = makeLargeArray<int16_t>(size)).get();
    }
};

/// Power labels as they are kept (medial/PowerMap.h): an offset along x, y and z a voxel.
using LabelOffsets = std::array<AxisOffsets, 3>;

} // namespace openvdb_spheretree::detail

namespace openvdb_spheretree::slab {

/// Arrays that receive the offsets of all leaves along x, y and z, 512 a leaf; null if not kept.
template <typename Power>
using KeptOffsets = std::array<typename Power::Offset*, 3>;

/// 512 entries a leaf, in leaf order.
template <typename Power>
struct SlabLabels {
    using Key = typename Power::Key;
    using Offset = typename Power::Offset;

    uint32_t firstLeaf = 0;
    Key* keys = nullptr;                 ///< after the passes along z and y
    Offset *dy = nullptr, *dz = nullptr; ///< dz is null in two dimensions
    /// Whether a voxel has the dz of the voxel that its own dy leads to, as packed labels have it.
    bool dzFollowsDy = false;

    Key* keysOf(uint32_t leaf) const { return keys + place(leaf); }
    Offset* dyOf(uint32_t leaf) const { return dy + place(leaf); }
    Offset* dzOf(uint32_t leaf) const { return dz + place(leaf); }

    /// @return the voxel that a voxel's offsets along y and z lead to.
    VoxelRef center(const LeafLayout& layout, VoxelRef voxel) const
    {
        const VoxelRef there = moved(layout, Axis::Y, voxel, dyOf(voxel.leaf)[voxel.index]);
        return moved(layout, Axis::Z, there, dzAfter(voxel, there));
    }
    /// @return the offset along z from @a there, the target of @a voxel along y.
    int dzAfter(VoxelRef voxel, VoxelRef there) const
    {
        if (!dz) return 0;
        const VoxelRef& from = dzFollowsDy ? voxel : there;
        return dzOf(from.leaf)[from.index];
    }

private:
    std::size_t place(uint32_t leaf) const { return std::size_t(leaf - firstLeaf) * kLeafVoxels; }
};

/// Memory for the labels of a slab, used again from slab to slab.
template <typename Power>
class SlabMemory {
    using Offset = typename Power::Offset;

public:
    /// @return the leaves that there is room for.
    uint32_t leaves() const { return mLeaves; }

    /// @return labels, undefined so far, of the slab that has the leaves @a range.
    SlabLabels<Power> open(LeafLayout::Slab range, int dim, const KeptOffsets<Power>& kept)
    {
        if (mLeaves < range.size()) {
            mLeaves = range.size();
            const std::size_t size = std::size_t(mLeaves) * kLeafVoxels;
            const auto axes = std::size_t(kept[0] ? 0 : dim - 1);
            mKeys.reset(); // before there is more
            mOffsets.reset();
            mKeys = detail::makeLargeArray<typename Power::Key>(size);
            if (axes) mOffsets = detail::makeLargeArray<Offset>(axes * size);
        }
        SlabLabels<Power> labels;
        labels.firstLeaf = range.begin;
        labels.keys = mKeys.get();
        const std::size_t before = std::size_t(range.begin) * kLeafVoxels;
        labels.dy = kept[1] ? kept[1] + before : mOffsets.get();
        if (dim == 2) return labels;
        labels.dz =
            kept[2] ? kept[2] + before : mOffsets.get() + std::size_t(range.size()) * kLeafVoxels;
        return labels;
    }

private:
    uint32_t mLeaves = 0;
    detail::LargeArray<typename Power::Key> mKeys;
    detail::LargeArray<Offset> mOffsets;
};

} // namespace openvdb_spheretree::slab
