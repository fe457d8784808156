// SPDX-License-Identifier: Apache-2.0
/// @file MergedLeaves.h
/// @brief What searches of tight trees start from: the cuts of merged leaves, and what levels of
/// balls have to keep, asked voxel by voxel.

#pragma once

#include "FineBalls.h"

#include <openvdb_spheretree/tight/level/LevelMaker.h>
#include <openvdb_spheretree/tight/level/TightLevels.h>
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include <cstdint>
#include <vector>

namespace spheretree_test {

using openvdb_spheretree::tight::FitEffort;
using openvdb_spheretree::tight::ForestNode;
using openvdb_spheretree::tight::LevelMaker;
using openvdb_spheretree::tight::SampleLevel;
using openvdb_spheretree::tight::TightLevel;
using openvdb_spheretree::tight::VoxelRegion;

struct MergedLeaves {
    static constexpr FitEffort kEffort{false, 12, 2, false, 16};

    Voxels voxels;
    SampledObject object;
    std::vector<ExactSphere> leaves;
    std::vector<ForestNode> forest;
    LevelMaker maker;

    /// @param flat  the object, which has z = 0 alone
    explicit MergedLeaves(const Voxels& some, bool flat = false, const FitEffort& effort = kEffort);
    MergedLeaves(const MergedLeaves&) = delete; // `maker` refers to `object`

    std::vector<ExactSphere> cut(int64_t count) const { return ballsOfCut(forest, count); }
    /// The cuts of these counts, with the parents of the forest.
    std::vector<TightLevel> levels(const std::vector<int64_t>& counts) const;
    std::vector<VoxelRegion> regions(const std::vector<ExactSphere>& balls) const;
};

/// The balls that are not empty.
std::vector<ExactSphere> thereOf(const std::vector<openvdb_spheretree::tight::CoverBall>& cover);

/// Expects that every voxel has a chain of balls through the levels, and no ball is empty or without a child.
/// @return the voxels outside the object in each level.
std::vector<int64_t> expectChains(const std::vector<TightLevel>& levels, const Voxels& voxels);

Voxels heldBy(const std::vector<ExactSphere>& balls, const Voxels& voxels);

/// @return the voxels of all parts, sorted.
Voxels together(const std::vector<Voxels>& parts);

/// The voxels of each region, sorted.
std::vector<Voxels> voxelsOf(const std::vector<VoxelRegion>& regions, const SampleLevel& object);

/// @return what each ball holds of its children's regions.
std::vector<Voxels> heldBelow(const std::vector<ExactSphere>& balls,
    const std::vector<int32_t>& parents, const std::vector<Voxels>& regions);

} // namespace spheretree_test
