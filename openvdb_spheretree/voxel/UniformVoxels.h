// SPDX-License-Identifier: Apache-2.0
/// @file UniformVoxels.h
/// @brief Voxels must be cubes in world space, so that spheres stay spheres.

#pragma once

#include "MaskTree.h"

#include <string>

namespace openvdb_spheretree {

/// Rotations, translations and uniform scales are fine. (OpenVDB's hasUniformScale() has an
/// absolute tolerance: it takes small voxels of any shape for cubes, and small rotated cubes for
/// none. Here it is relative, 1e-6.)
/// @throw openvdb::ValueError naming the grid and its voxel size, unless its voxels are cubes
void requireUniformVoxels(const openvdb::GridBase& grid);

/// @return whether they are cubes, by the same measure; also where they are too far away to be told apart.
bool hasCubicVoxels(const openvdb::math::Transform& transform);

/// @return how long the first edge of a voxel is in world units, wherever the object is. (Transform::voxelSize()
///         of a turned grid is the distance between two of its places: 10^8 voxels away from the world's
///         origin it has eight digits less. Of a frustum, whose voxels differ, it is that number.)
double voxelSizeOf(const openvdb::math::Transform& transform);

/// @return an upper bound of the world units a voxel, over all directions: the voxel size, a hair
///         more where voxels are cubes only nearly.
double largestStretch(const openvdb::math::Transform& transform);

/// @return the same from below.
double smallestStretch(const openvdb::math::Transform& transform);

namespace detail {
/// @return what messages call the grid: "grid 'name'", of a sane length whatever the name.
std::string describe(const openvdb::GridBase& grid);
} // namespace detail

} // namespace openvdb_spheretree
