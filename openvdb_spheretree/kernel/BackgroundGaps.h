// SPDX-License-Identifier: Apache-2.0
/// @file BackgroundGaps.h
/// @brief Gaps along x through one leaf, 64 lanes 8 y + z side by side.
///
/// The gap of a voxel is its distance to the next background voxel on its line, in one direction;
/// background has the gap 0. A gap too large for its type stays at the largest number.

#pragma once

#include <openvdb_spheretree/voxel/LeafMask.h>

#include <cstdint>

namespace openvdb_spheretree::slab {

/// @param beside  gaps, looking back, of the voxels just before the leaf, a lane each
/// @param last    receives those of the leaf's last voxels
/// @param back    the same in the other direction: from the voxels just behind the leaf, looking
///                on, to its first ones
void gapsThrough(const LeafMask& mask, const uint8_t* beside, uint8_t* last, bool back);
void gapsThrough(const LeafMask& mask, const uint16_t* beside, uint16_t* last, bool back);

/// @param rows  receives the square of each voxel's smaller gap, as rows across y (LeafRows.h);
///              gaps beyond 255, or 46340, count as that much
void squaresOfGaps(
    const LeafMask& mask, const uint8_t* before, const uint8_t* behind, uint16_t* rows);
void squaresOfGaps(
    const LeafMask& mask, const uint16_t* before, const uint16_t* behind, uint32_t* rows);

} // namespace openvdb_spheretree::slab
