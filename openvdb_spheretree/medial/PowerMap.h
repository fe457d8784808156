// SPDX-License-Identifier: Apache-2.0
/// @file PowerMap.h
/// @brief Power labels: for every object voxel, the medial ball that covers it best.
///
/// The label of voxel q is the object voxel p that maximises distSq(p) - |p - q|^2, then distSq(p),
/// then comes first in the order of Coord::operator< (the power diagram of CM07, section 3,
/// restricted to the object). The passes run z, y, x, each a max over the line of value - offset^2
/// (kernel/MaxPlus.h); x coming last gives the rule of the first site. They are made slab by slab
/// (slab/LabelStream.h).
///
/// What is kept is one small offset a voxel and axis: the label of q is found by going dx(q) along
/// x, from there dy along y, and from there dz along z. Offsets have 8 bits for radii up to 127
/// voxels, else 16. For a norm N of the 3x3x3 neighbourhood (Distance.h) the power is
/// distance(p) - N(p - q), ties as above; the label itself is kept, 4 bytes a voxel (NormSweep.h).
///
/// Exact, integer, ties included. Cost: as the distance transform's; 3 or 6 bytes a voxel kept, 4
/// or 8 more while it runs. Tests: TestTransformsOracle.cc, against all
/// sites one by one; TestPowerMap.cc, ties by hand.

#pragma once

#include "DistanceMap.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/slab/SlabLabels.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/VoxelRef.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <utility>

namespace openvdb_spheretree {

class PowerMap {
public:
    PowerMap() = default;
    /// @param layout  kept by reference
    PowerMap(const LeafLayout& layout, detail::LabelOffsets offsets)
        : mLayout(&layout), mOffsets(std::move(offsets))
    {}

    /// @return the label of the object voxel @a voxel.
    VoxelRef label(VoxelRef voxel) const
    {
        if (mSites) {
            const uint32_t site = mSites[std::size_t(voxel.leaf) * kLeafVoxels + voxel.index];
            return {site / kLeafVoxels, site % kLeafVoxels};
        }
        voxel = target(Axis::X, voxel);
        voxel = target(Axis::Y, voxel);
        return usesZ() ? target(Axis::Z, voxel) : voxel;
    }
    /// @return the label of @a ijk, in coordinates of the level. O(log leaves).
    /// @throw openvdb::LookupError if @a ijk is no object voxel
    openvdb::Coord label(const openvdb::Coord& ijk) const;

    /// @return the offset of a voxel along @a axis; only for the Euclidean distance.
    int offset(Axis axis, VoxelRef voxel) const
    {
        const std::size_t i = std::size_t(voxel.leaf) * kLeafVoxels + voxel.index;
        const detail::AxisOffsets& offsets = mOffsets[int(axis)];
        return offsets.narrow ? offsets.narrow[i] : offsets.wide[i];
    }
    /// @return the voxel that it leads to, in the same run.
    VoxelRef target(Axis axis, VoxelRef voxel) const
    {
        return moved(*mLayout, axis, voxel, offset(axis, voxel));
    }
    /// The 512 offsets of a leaf along @a axis, as they are stored: one of these two is null, both
    /// with a norm.
    const int8_t* narrowOffsets(Axis axis, uint32_t leaf) const
    {
        const detail::AxisOffsets& offsets = mOffsets[int(axis)];
        return offsets.narrow ? offsets.narrow.get() + std::size_t(leaf) * kLeafVoxels : nullptr;
    }
    const int16_t* wideOffsets(Axis axis, uint32_t leaf) const
    {
        const detail::AxisOffsets& offsets = mOffsets[int(axis)];
        return offsets.wide ? offsets.wide.get() + std::size_t(leaf) * kLeafVoxels : nullptr;
    }

    const LeafLayout& layout() const { return *mLayout; }
    bool usesZ() const { return !mOffsets[2].empty(); }

private:
    friend PowerMap normLabels(
        const LeafLayout&, const DistanceMap&, int, openvdb::util::NullInterrupter*);

    const LeafLayout* mLayout = nullptr;
    detail::LabelOffsets mOffsets;
    detail::LargeArray<uint32_t> mSites; ///< of a norm: 512 leaf + index of each voxel's label
};

/// @return the power labels of a norm. Those of the Euclidean distance come from
///         slab/LabelStream.h.
/// @param layout     kept by reference: must outlive the result
/// @param distances  of that layout, by the norm
/// @param dim        3, or 2 to leave the z axis out
/// @throw openvdb::ValueError if labels exceed the machine's memory, or leaves 2^23
/// @throw Interrupted if the interrupter (may be null) said so
PowerMap normLabels(const LeafLayout& layout, const DistanceMap& distances, int dim,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree
