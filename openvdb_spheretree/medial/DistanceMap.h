// SPDX-License-Identifier: Apache-2.0
/// @file DistanceMap.h
/// @brief The distances of DistanceTransform.h as flat arrays, and the transform that computes
/// them.
///
/// CM07 (Coeurjolly, Montanvert, IEEE PAMI 2007), cut at every run of object voxels: no value
/// crosses background.
///
/// 1. x: the gap to the background on the voxel's own line, squared (slab/XGaps.h);
/// 2. y, then z: min over the line of value + offset^2 (kernel/MinPlus.h), slab by slab
///    (slab/SlabDistance.h).
///
/// Norms have sweeps of their own (NormSweep.h). Euclidean values are computed in 16 bits, and
/// again in 32 bits if one of them turns out not to fit.

#pragma once

#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/voxel/Distance.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstddef>
#include <cstdint>

namespace openvdb_spheretree {

/// Distances of the voxels of a level, 512 a leaf in leaf order; background has 0. Euclidean ones
/// are squared, in voxels^2. Those of a norm are not squared, and in its units (Distance::unit()).
class DistanceMap {
public:
    /// @return the distance at a voxel of a leaf, by leafIndex().
    uint32_t at(uint32_t leaf, uint32_t index) const
    {
        const std::size_t i = std::size_t(leaf) * kLeafVoxels + index;
        return mNarrow ? mNarrow[i] : mWide[i];
    }
    /// The largest value in the level; 0 only if the level is empty.
    uint32_t largest() const { return mLargest; }
    const Distance& distance() const { return mDistance; }

    /// The values as they are stored: one of these two is null.
    const uint16_t* narrow() const { return mNarrow.get(); }
    const uint32_t* wide() const { return mWide.get(); }

private:
    friend DistanceMap distanceTransform(
        const LeafLayout&, int, const Distance&, openvdb::util::NullInterrupter*);

    detail::LargeArray<uint16_t> mNarrow;
    detail::LargeArray<uint32_t> mWide;
    uint32_t mLargest = 0;
    Distance mDistance;
};

/// @param dim  3, or 2 to leave the z axis out
/// @throw openvdb::ValueError if a radius is 46340 voxels (units of a norm) or more: 32 bits do not
///        hold its square
/// @throw Interrupted if the interrupter (may be null) said so
DistanceMap distanceTransform(const LeafLayout& layout, int dim = 3, const Distance& distance = {},
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief The same, Euclidean, into the caller's memory.
/// @param values  512 a leaf, in leaf order; aligned to 16 bytes. All are written, those of
///                background with 0.
/// @return the largest of them.
/// @throw openvdb::ValueError if memory is not aligned, or a radius is 46340 voxels or more
/// @throw Interrupted
uint32_t distanceTransform(const LeafLayout& layout, int32_t* values, int dim = 3,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
