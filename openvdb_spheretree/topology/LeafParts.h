// SPDX-License-Identifier: Apache-2.0
/// @file LeafParts.h
/// @brief The connected parts of the voxels of a leaf, and of the background in it, within the
/// leaf.

#pragma once

#include <openvdb_spheretree/voxel/LeafMask.h>

#include <array>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// For each voxel of a leaf its part, from 0 on: of the object if it is on, else of the background.
/// A byte suffices: 64 parts of the object (one in every 2 x 2 x 2 voxels), 256 of the background
/// (every other voxel) are the most there can be.
using PartLabels = std::array<uint8_t, kLeafVoxels>;

struct PartCounts {
    int object = 0;     ///< 26-connected
    int background = 0; ///< 6-connected
};

/// @param labels  receives the labels
PartCounts leafParts(const LeafMask& mask, PartLabels& labels);

} // namespace openvdb_spheretree::detail
