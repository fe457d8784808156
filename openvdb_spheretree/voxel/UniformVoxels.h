// SPDX-License-Identifier: Apache-2.0
/// @file UniformVoxels.h
/// @brief The one thing asked of a transform: that voxels are cubes, so that spheres stay spheres.

#pragma once

#include "MaskTree.h"

namespace openvdb_spheretree {

/// @brief Rotations, translations and uniform scales are fine.
/// OpenVDB's hasUniformScale() compares with an absolute tolerance, so it takes small voxels of any
/// shape for cubes, and small rotated cubes for none; this comparison is relative, to 1e-6.
/// @throw openvdb::ValueError naming the grid and its voxel size
void requireUniformVoxels(const openvdb::GridBase& grid);

/// @return a bound on how far index space is stretched in any direction, in world units a voxel:
/// the voxel size, a hair more where the voxels are cubes only nearly.
double largestStretch(const openvdb::math::Transform& transform);

/// @return the same from below: the voxel size, or a hair less.
double smallestStretch(const openvdb::math::Transform& transform);

} // namespace openvdb_spheretree
