// SPDX-License-Identifier: Apache-2.0
/// @file TightObjects.h
/// @brief Small objects for tight trees, and what holds of every one of their trees: chains of spheres by
/// brute force, the check, the object in the leaf balls.

#pragma once

#include "BuiltTrees.h"

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <string>
#include <vector>

namespace spheretree_test {

using openvdb_spheretree::Cover;
using openvdb_spheretree::Leaves;
using openvdb_spheretree::Quality;
using openvdb_spheretree::SphereBudget;
using openvdb_spheretree::SphereCuts;
using openvdb_spheretree::SphereTree;
using openvdb_spheretree::SphereTreeSettings;
using openvdb_spheretree::TreeType;

Voxels joined(const Voxels& a, const Voxels& b);

/// Small enough for brute force; across the borders of leaves and of the sign of coordinates.
std::vector<RandomObject> smallObjects();

SphereTreeSettings tightSettings(Quality quality);

/// What a tree is to cover, made of which leaves, with cuts, padded.
std::vector<SphereTreeSettings> tightVariants(Quality quality);

std::string describeTight(const SphereTreeSettings& s);

/// Level 0 of a tree whose leaves are digital balls.
Voxels rebuilt(const SphereTree& tree);

void expectChains(const SphereTree& tree, const Voxels& voxels);

void expectSound(const SphereTree& tree, const openvdb::BoolGrid& grid, const Voxels& voxels);

/// Every number of spheres there is.
void expectCutsHold(const SphereTree& tree, const Voxels& voxels);

} // namespace spheretree_test
