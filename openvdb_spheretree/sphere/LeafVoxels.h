// SPDX-License-Identifier: Apache-2.0
/// @file LeafVoxels.h
/// @brief Which voxels of an 8x8x8 leaf a sphere holds, exactly.

#pragma once

#include "ExactSphere.h"
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <openvdb/math/Coord.h>

namespace openvdb_spheretree {
namespace detail {

/// @param shift  2^shift units of the sphere are a voxel: 1 to 4
/// @return the voxels of the leaf at @a origin that lie in @a sphere, a Euclidean one.
LeafMask voxelsOf(const ExactSphere& sphere, int shift, const openvdb::Coord& origin);

} // namespace detail
} // namespace openvdb_spheretree
