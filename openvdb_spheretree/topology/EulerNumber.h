// SPDX-License-Identifier: Apache-2.0
/// @file EulerNumber.h
/// @brief The Euler characteristic of voxels as closed cubes, leaf by leaf.

#pragma once

#include <openvdb_spheretree/voxel/LeafWalk.h>

#include <cstdint>

namespace openvdb_spheretree::detail {

/// @brief What a leaf's voxels add to vertices - edges + faces - cubes when all voxels are added in
/// order; the sum over all leaves is the Euler characteristic.
/// @param around  stands at the leaf
int64_t eulerOfLeaf(const LeafLayout& layout, const LeafWalk& around);

} // namespace openvdb_spheretree::detail
