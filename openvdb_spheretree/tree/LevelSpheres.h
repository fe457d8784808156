// SPDX-License-Identifier: Apache-2.0
/// @file LevelSpheres.h
/// @brief The spheres of a level of a tree as exact spheres, and the voxels that they cover.

#pragma once

#include "SphereTree.h"
#include <openvdb_spheretree/sphere/SphereUnion.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree {

/// @return that of the spheres of a tree.
SphereMetric metricOf(const SphereTree& tree);

/// @return the spheres of a level, in index space of the tree's source grid (without padding), by
///         metricOf() the tree.
std::vector<ExactSphere> levelSpheres(const SphereTree& tree, const SphereTreeLevel& level);

/// @return the same as files have them: with stored radii, padding and all. The tree must have its
///         stored radii and its transform.
std::vector<ExactSphere> storedSpheres(const SphereTree& tree, const SphereTreeLevel& level);

/// @return a stored radius in voxels. Rounded up by more than the division is off, and by less than
///         a float: a voxel center on a stored sphere counts as held.
double storedRadiusVoxels(const SphereTree& tree, int32_t id);

/// @return the smallest box that holds every voxel center in spheres of a level of @a tree; in 2-D
///         only their plane.
openvdb::CoordBBox levelBox(const SphereTree& tree, const std::vector<ExactSphere>& spheres);

/// @brief The voxels that a level covers: those whose centers lie in its spheres.
/// @throw openvdb::ValueError if they cross more than kMaxUnionRows
openvdb::MaskTree::Ptr levelUnion(const SphereTree& tree, const SphereTreeLevel& level,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
