// SPDX-License-Identifier: Apache-2.0
/// @file TreeCheck.h
/// @brief Verifies a finished sphere-tree against its object: everything it guarantees, recomputed
/// from what is stored.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <string>
#include <vector>

namespace openvdb_spheretree {

/// @brief Check that: the object lies where the tree has it, in world space; level 0 rebuilds the
/// object exactly; no level misses a voxel, in the exact radii and in the stored floats; every
/// non-root has one parent on the next level; every inner node of an extended tree has a child, and
/// contains the leaf balls below it in the stored floats; the recorded counts are right; edges of
/// the Sphere-DAG, where there are any, are the object's.
///
/// Of a tight tree: every voxel of the object has a chain of nodes, one a level, each the child of
/// the one above, that all hold it, in the exact radii and in the stored floats; where there are
/// cuts, those of 1, 2, 4, ... and all spheres have such chains up to them. With cover=balls every
/// node contains the leaf balls below it as well. Of one with side=inner: no sphere holds a voxel
/// that the object has not, and that is all.
///
/// Not checked: *which* node of the next level is a parent, beyond what it must contain.
/// @return a sentence for each thing that failed, with the first offender; empty if all holds
std::vector<std::string> checkSphereTree(const SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
