// SPDX-License-Identifier: Apache-2.0
/// @file CheckedTrees.h
/// @brief A small valid tree written down by hand, to be damaged, and what the check says of it.

#pragma once

#include <openvdb_spheretree/check/TreeCheck.h>

#include <functional>
#include <string>
#include <vector>

namespace spheretree_test {

/// A plus of seven voxels around (2, 2, 2), and the voxel (9, 2, 2). Voxels of 1/2.
openvdb::SharedPtr<openvdb::BoolGrid> plusAndDot();

/// Nodes are added from the top level down.
void addSphere(openvdb_spheretree::SphereTree& tree, const openvdb::Vec3d& center, int64_t coverSq,
    int32_t parent);

/// A valid tree of plusAndDot(): three levels of 2, 2 and 1 nodes.
openvdb_spheretree::SphereTree plusAndDotTree(const openvdb::BoolGrid& object,
    openvdb_spheretree::TreeType type = openvdb_spheretree::TreeType::Extended);

/// @return the sentences, one a line; empty if there is no fault.
std::string sentencesOf(const std::vector<openvdb_spheretree::TreeFault>& faults);

/// Damages plusAndDotTree(); the check must report exactly this (other things may follow from it).
void expectFault(openvdb_spheretree::FaultKind kind,
    const std::function<void(openvdb_spheretree::SphereTree&)>& damage, const std::string& sentence,
    openvdb_spheretree::TreeType type = openvdb_spheretree::TreeType::Extended);

} // namespace spheretree_test
