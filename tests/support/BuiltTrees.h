// SPDX-License-Identifier: Apache-2.0
/// @file BuiltTrees.h
/// @brief For tests that build sphere-trees: the settings there are, and questions to a finished
/// tree.

#pragma once

#include "CoreStages.h"
#include "RandomObjects.h"
#include "TreeSettings.h"

#include <openvdb_spheretree/tree/SphereTree.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace spheretree_test {

using openvdb_spheretree::ParentRule;
using openvdb_spheretree::RadiusScale;
using openvdb_spheretree::Reconstruction;
using openvdb_spheretree::SphereTree;
using openvdb_spheretree::SphereTreeLevel;
using openvdb_spheretree::SphereTreeSettings;
using openvdb_spheretree::TreeType;

std::string describe(const SphereTreeSettings& s);

/// Every combination of factors 2 and 3, parent rules and radius scales, and for the extended tree
/// of final fit and reconstruction; with the DAG.
std::vector<SphereTreeSettings> allSettings(TreeType type, int dim);

/// The norms, with factors 2 and 3, both parent rules, and for the extended tree both fits.
std::vector<SphereTreeSettings> normSettings(TreeType type, int dim);

/// Both types, all settings, three dimensions.
std::vector<SphereTreeSettings> allSettings();

/// @return settings of a tree of the pyramid, with everything else as it comes.
SphereTreeSettings settingsFor(TreeType type);

inline SphereTreeSettings extendedTree() { return settingsFor(TreeType::Extended); }

/// The two types of tree of the pyramid.
std::vector<SphereTreeSettings> bothTypes();

/// All voxels brought to the height of the lowest.
Voxels flattened(Voxels voxels);

/// Small objects of every shape of randomObject().
std::vector<RandomObject> someObjects(uint32_t firstSeed, uint32_t count);

bool holds(const SphereTree& tree, int32_t id, const Coord& q);

/// One entry a node: levels, links, spheres. Not what the tree knows of its object.
testing::AssertionResult sameNodes(const SphereTree& a, const SphereTree& b);

/// One level of one node on top, which everything else hangs on.
testing::AssertionResult endsAtOneRoot(const SphereTree& tree);

/// Every voxel lies in a sphere of every level, by the exact radii.
testing::AssertionResult covers(const SphereTree& tree, const Voxels& voxels);

} // namespace spheretree_test
