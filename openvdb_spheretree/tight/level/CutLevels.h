// SPDX-License-Identifier: Apache-2.0
/// @file CutLevels.h
/// @brief Levels that are cuts of one forest of merges (MergeForest.h): any number of spheres is a
/// level, and a coarser one is a union of its nodes.

#pragma once

#include "LevelMaker.h"
#include "TightLevels.h"
#include <openvdb_spheretree/tight/region/LeafBalls.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <vector>

namespace openvdb_spheretree::tight {

/// @param tree    receives the cuts themselves if its settings say so
/// @param leaves  of the object
/// @return levels of as many balls as the settings say, finest first.
/// @throw as levelCounts()
std::vector<TightLevel> cutLevels(SphereTree& tree, const openvdb::BoolGrid& object,
    const LeafBalls& leaves, const LevelMaker& maker);

} // namespace openvdb_spheretree::tight
