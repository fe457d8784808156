// SPDX-License-Identifier: Apache-2.0
/// @file TreeCheck.h
/// @brief Verifies a finished sphere-tree against its object: everything it guarantees, recomputed
/// from what is stored.

#pragma once

#include "SphereTree.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace openvdb_spheretree {

/// @brief Check that: the object lies where the tree has it, in world space; level 0 rebuilds the
/// object exactly; no level misses a voxel, in the exact radii and in the stored floats; every
/// non-root has one parent on the next level; every inner node of an extended tree has a child, and
/// contains the leaf balls below it in the stored floats; the recorded counts are right; edges of
/// the Sphere-DAG, where there are any, are the object's. Not checked: *which* node of the next
/// level is a parent, beyond what it must contain.
/// @return a sentence for each thing that failed, with the first offender; empty if all holds
std::vector<std::string> checkSphereTree(const SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
