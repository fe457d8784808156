// SPDX-License-Identifier: Apache-2.0
/// @file PowerMap.h
/// @brief Power labels: for every object voxel, the medial ball that covers it best.
///
/// The label of voxel q is the object voxel p that maximises distSq(p) - |p - q|^2, then distSq(p),
/// then comes first in the order of Coord::operator< (the power diagram of CM07, section 3,
/// restricted to the object). The passes run z, y, x, each a max over the line of value - step^2
/// (kernel detail/MaxPlus.h); x coming last gives the smallest-site rule. They are made slab by slab
/// (slab/LabelStream.h).
///
/// What is kept is one small offset a voxel and axis: the label of q is found by going dx(q) along
/// x, from there dy along y, and from there dz along z. Keys are 32-bit with 8-bit offsets for
/// radii up to 127 voxels, else 64-bit with 16-bit offsets.
///
/// For a norm N of the 3x3x3 neighbourhood (Distance.h) the power is distance(p) - N(p - q), ties
/// as above; the label itself is kept, 4 bytes a voxel (detail/NormSweep.h).
///
/// Exact, integer, ties included. Cost: as the distance transform's; 3 or 6 bytes a voxel kept, 4
/// or 8 more while it runs. Tests: TestPowerMap.cc, against all sites one by one.

#pragma once

#include "DistanceMap.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/slab/LabelSteps.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/VoxelRef.h>

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <utility>

namespace openvdb_spheretree {

class PowerMap {
public:
    PowerMap() = default;
    /// @param layout  kept by reference
    PowerMap(const LeafLayout& layout, detail::LabelSteps steps)
        : mLayout(&layout), mSteps(std::move(steps))
    {}

    /// @return the label of the object voxel @a voxel.
    VoxelRef label(VoxelRef voxel) const
    {
        if (mSites) {
            const uint32_t site = mSites[std::size_t(voxel.leaf) * kLeafVoxels + voxel.index];
            return {site / kLeafVoxels, site % kLeafVoxels};
        }
        voxel = step(Axis::X, voxel);
        voxel = step(Axis::Y, voxel);
        return mSteps[2].empty() ? voxel : step(Axis::Z, voxel);
    }
    /// @return the label of @a ijk, in coordinates of the level. O(log leaves).
    /// @throw openvdb::LookupError if @a ijk is no object voxel
    openvdb::Coord label(const openvdb::Coord& ijk) const;

    /// @return whether labels are kept as steps, as those of the Euclidean distance are. Without,
    ///         there are no steps to ask for below.
    bool hasSteps() const { return !mSites; }

    /// @return how far along @a axis the voxel's own step goes.
    int offset(Axis axis, VoxelRef voxel) const
    {
        const std::size_t i = std::size_t(voxel.leaf) * kLeafVoxels + voxel.index;
        const detail::AxisSteps& steps = mSteps[int(axis)];
        return steps.narrow ? steps.narrow[i] : steps.wide[i];
    }
    /// @return the voxel at the end of that step, in the same run.
    VoxelRef step(Axis axis, VoxelRef voxel) const
    {
        return moved(*mLayout, axis, voxel, offset(axis, voxel));
    }
    /// The 512 steps of a leaf along @a axis, as they are stored: one of these two is null.
    const int8_t* narrowSteps(Axis axis, uint32_t leaf) const
    {
        const detail::AxisSteps& steps = mSteps[int(axis)];
        return steps.narrow ? steps.narrow.get() + std::size_t(leaf) * kLeafVoxels : nullptr;
    }
    const int16_t* wideSteps(Axis axis, uint32_t leaf) const
    {
        const detail::AxisSteps& steps = mSteps[int(axis)];
        return steps.wide ? steps.wide.get() + std::size_t(leaf) * kLeafVoxels : nullptr;
    }

    const LeafLayout& layout() const { return *mLayout; }
    bool usesZ() const { return !mSteps[2].empty(); }

private:
    friend PowerMap powerMap(
        const LeafLayout&, const DistanceMap&, int, openvdb::util::NullInterrupter*);

    const LeafLayout* mLayout = nullptr;
    detail::LabelSteps mSteps;
    detail::LargeArray<uint32_t> mSites; ///< of a norm: 512 leaf + offset of each voxel's label
};

/// @param layout     kept by reference: must outlive the result
/// @param distances  of that layout; labels are for the distance they were made with
/// @param dim        3, or 2 to leave the z axis out
/// @throw openvdb::ValueError if a radius exceeds 32767 voxels, labels the machine's memory, or
///        leaves 2^23 with a norm
/// @throw Interrupted if the interrupter (may be null) said so
PowerMap powerMap(const LeafLayout& layout, const DistanceMap& distances, int dim = 3,
    openvdb::util::NullInterrupter* interrupter = nullptr);
PowerMap powerMap(LeafLayout&& layout, const DistanceMap& distances, int dim = 3,
    openvdb::util::NullInterrupter* interrupter = nullptr) = delete; // it would not live on

} // namespace openvdb_spheretree
