// SPDX-License-Identifier: Apache-2.0
/// @file LeafVoxels.h
/// @brief Which voxels of an 8x8x8 leaf a sphere holds, exactly: by a kernel where its 16 or 32
/// bits suffice, else row by row.

#pragma once

#include "ClippedSphere.h"
#include <openvdb_spheretree/voxel/LeafMask.h>

namespace openvdb_spheretree::detail {

/// @param shift     2^shift units of the sphere are a voxel: 1 to 10
/// @param origin    of the leaf
/// @param distance  that the sphere is a ball of
/// @return the voxels of the leaf that lie in @a sphere, wherever it is and however large.
LeafMask voxelsOf(const ExactSphere& sphere, int shift, const openvdb::Coord& origin,
    const Distance& distance = {});

/// Adds to @a mask the voxels of the leaf at @a origin that lie in @a sphere and in its clip. The
/// sphere's box must meet the leaf.
void addVoxelsOf(const ClippedSphere& sphere, const openvdb::Coord& origin, LeafMask& mask);

} // namespace openvdb_spheretree::detail
