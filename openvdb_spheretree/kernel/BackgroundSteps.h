// SPDX-License-Identifier: Apache-2.0
/// @file BackgroundSteps.h
/// @brief Steps to the background along x through one leaf, 64 lanes 8 y + z side by side.

#pragma once

#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <cstdint>

namespace openvdb_spheretree {
namespace slab {

/// @param before  steps to the background of the voxels before the leaf, 0 for background
/// @param last    receives those of the leaf's last voxels, counted from there
void stepsThrough(const LeafMask& mask, const uint8_t* before, uint8_t* last);
void stepsThrough(const LeafMask& mask, const uint16_t* before, uint16_t* last);
/// The same in the other direction.
void stepsBackThrough(const LeafMask& mask, const uint8_t* behind, uint8_t* first);
void stepsBackThrough(const LeafMask& mask, const uint16_t* behind, uint16_t* first);

/// @param rows  receives the squares of the shorter way to the background, 0 for background, as rows
///              across y (detail/LeafRows.h). At most 255^2, or 46340^2.
void squaresOfSteps(
    const LeafMask& mask, const uint8_t* before, const uint8_t* behind, uint16_t* rows);
void squaresOfSteps(
    const LeafMask& mask, const uint16_t* before, const uint16_t* behind, uint32_t* rows);

} // namespace slab
} // namespace openvdb_spheretree
