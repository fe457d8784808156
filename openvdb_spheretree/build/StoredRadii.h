// SPDX-License-Identifier: Apache-2.0
/// @file StoredRadii.h
/// @brief Radii as files hold them: in world units, padded, and rounded up to floats, so that a
/// stored sphere covers what it stands for.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree::detail {

/// @brief Fill in `radiusWorld` of a tree's nodes and cuts from their radii.
/// @throw openvdb::ValueError if a radius does not fit a float
void storeRadii(SphereTree& tree, openvdb::util::NullInterrupter* interrupter);

/// @brief Make stored spheres contain the stored leaf spheres below them.
/// @param radii  of nodes, in voxels: they contain the leaf balls below; not read of leaves
/// @throw openvdb::ValueError if a radius does not fit a float
void containStoredLeaves(SphereTree& tree, const std::vector<double>& radii,
    openvdb::util::NullInterrupter* interrupter);

/// @return radii, in voxels, with which the nodes of a tight tree contain the balls of level 0
///         below them. (Level 0 may be a cut; nodes were made to contain the leaves below the cut.)
///         Such trees are small.
std::vector<double> radiiAroundCut(const SphereTree& tree);

} // namespace openvdb_spheretree::detail
