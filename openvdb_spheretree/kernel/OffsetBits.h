// SPDX-License-Identifier: Apache-2.0
/// @file OffsetBits.h
/// @brief Where the offsets of power labels lead, as mask words.
///
/// A voxel's *target* is the voxel that its offset along an axis leads to. Neighbours mostly share
/// it, so it is looked up once for all of them.

#pragma once

#include "LeafRows.h"
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <cstdint>

namespace openvdb_spheretree::detail {

/// @param offsets  512 of a leaf along @a axis, in leaf order
/// @return the voxels with the target of the voxel before them along the axis, in the same leaf;
///         none in words where @a mask is empty.
LeafMask targetsAsBefore(const int8_t* offsets, Axis axis, const LeafMask& mask);
LeafMask targetsAsBefore(const int16_t* offsets, Axis axis, const LeafMask& mask);

/// Voxels whose target the voxel before them along the axis has not.
struct FreshOffsets {
    LeafMask stay; ///< their offset is 0: they are their own targets
    LeafMask go;   ///< it is not
};

/// @return those among the voxels of @a mask, which are compared with each other alone.
FreshOffsets freshOffsets(const int8_t* offsets, Axis axis, const LeafMask& mask);
FreshOffsets freshOffsets(const int16_t* offsets, Axis axis, const LeafMask& mask);

/// @brief Marks the targets of offsets from row to row (LeafRows.h).
/// @param on     the lanes of each row that have an offset
/// @param marks  a word a row; targets may lie in rows before the first and behind the last
void markRowTargets(const int8_t* offsets, const uint64_t* on, int rows, uint64_t* marks);
void markRowTargets(const int16_t* offsets, const uint64_t* on, int rows, uint64_t* marks);

} // namespace openvdb_spheretree::detail
