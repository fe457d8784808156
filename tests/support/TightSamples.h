// SPDX-License-Identifier: Apache-2.0
/// @file TightSamples.h
/// @brief Tight trees without their builder: random ones that keep the contract of chains, if far
/// from tightly. Every node owns some voxels, those of its children together; its sphere is any
/// that holds them.

#pragma once

#include "RandomObjects.h"

#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <vector>

namespace spheretree_test {

using openvdb_spheretree::SphereCuts;
using openvdb_spheretree::SphereTree;
using openvdb_spheretree::SphereTreeLevel;
using Groups = std::vector<Voxels>;

/// A float that is no less.
float floatAbove(double x);

/// A tree of the object's own description, without nodes.
SphereTree describedTree(const openvdb::BoolGrid& object);

/// Partitions of the voxels, each of fewer parts than the one before, the last of one.
struct Hierarchy {
    std::vector<Groups> levels;
    std::vector<std::vector<int>> parents; ///< of the groups of a level, on the next

    Hierarchy(const Voxels& voxels, int leaves, Random& random);
};

SphereTree randomTightTree(
    const openvdb::BoolGrid& object, const Hierarchy& hierarchy, Random& random);

/// Leaves that own the groups, and @a idle ones that own nothing, merged or ended one at a time.
void addRandomCuts(SphereTree& tree, const Groups& groups, int idle, Random& random);

} // namespace spheretree_test
