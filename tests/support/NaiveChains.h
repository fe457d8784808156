// SPDX-License-Identifier: Apache-2.0
/// @file NaiveChains.h
/// @brief Chains of spheres by their definition, voxel by voxel and node by node. Shares nothing
/// with the library but the arrays of a tree.

#pragma once

#include "NaiveReference.h"

#include <openvdb_spheretree/tree/SphereTree.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace spheretree_test {

/// Whether node @a id holds a voxel.
using HoldsVoxel = std::function<bool(int32_t id, const Coord& voxel)>;

/// @param nodes  of a tree, or the cuts of one
HoldsVoxel holdsExactly(const openvdb_spheretree::Spheres& nodes, int subdivision);

/// In world space, as a reader of the file sees it.
HoldsVoxel holdsStored(
    const openvdb_spheretree::Spheres& nodes, const openvdb_spheretree::SphereTree& tree);

/// How many voxels have a chain of nodes from level 0 up to level k - 1 but not k, for each k.
std::vector<int64_t> naiveBrokenLevels(
    const openvdb_spheretree::SphereTree& tree, const Voxels& voxels, const HoldsVoxel& holds);

/// How many voxels have no chain of nodes from a leaf up to the cut of that many spheres.
int64_t naiveBrokenCut(const openvdb_spheretree::SphereCuts& cuts, int32_t leaves, int32_t spheres,
    const Voxels& voxels, const HoldsVoxel& holds);

} // namespace spheretree_test
