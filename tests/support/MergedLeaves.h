// SPDX-License-Identifier: Apache-2.0
/// @file MergedLeaves.h
/// @brief What searches of tight trees start from: the cuts of merged leaves, and what levels of
/// balls have to keep, asked voxel by voxel.

#pragma once

#include "FineBalls.h"

#include <openvdb_spheretree/tight/level/LevelMaker.h>
#include <openvdb_spheretree/tight/level/TightLevels.h>
#include <openvdb_spheretree/tight/merge/SlackMerging.h>
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

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
    explicit MergedLeaves(const Voxels& some, bool flat = false, const FitEffort& effort = kEffort)
        : voxels(some), object(sampled(voxels)), maker{object, effort, flat, nullptr}
    {
        using namespace openvdb_spheretree::tight;
        for (const auto& ball : CoreStages(*maskOf(voxels)).balls) leaves.push_back(fineBall(ball));
        SlackMerging model(object, ungrouped(leaves), regionsOf(leaves, object.level(0), nullptr),
            effort, flat, nullptr);
        forest = mergeToRoots(model, 6, nullptr);
    }
    MergedLeaves(const MergedLeaves&) = delete; // `maker` refers to `object`

    std::vector<ExactSphere> cut(int64_t count) const { return ballsOfCut(forest, count); }
    /// The cuts of these counts, with the parents of the forest.
    std::vector<TightLevel> levels(const std::vector<int64_t>& counts) const
    {
        return levelsOf(forest, counts,
            std::vector<openvdb_spheretree::MedialBall>(leaves.size(), {Coord(), 1}));
    }
    std::vector<VoxelRegion> regions(const std::vector<ExactSphere>& balls) const
    {
        return regionsOf(balls, object.level(0), nullptr);
    }
};

/// The balls that are not empty.
inline std::vector<ExactSphere> thereOf(
    const std::vector<openvdb_spheretree::tight::CoverBall>& cover)
{
    std::vector<ExactSphere> balls;
    for (const auto& ball : cover) {
        if (!ball.empty()) balls.push_back(ball.ball);
    }
    return balls;
}

inline Voxels heldBy(const std::vector<ExactSphere>& balls, const Voxels& voxels)
{
    Voxels held;
    for (const Coord& v : voxels) {
        const bool any = std::any_of(
            balls.begin(), balls.end(), [&](const ExactSphere& ball) { return holds(ball, v); });
        if (any) held.push_back(v);
    }
    return held;
}

/// @return the voxels of all parts, sorted.
inline Voxels together(const std::vector<Voxels>& parts)
{
    Voxels all;
    for (const Voxels& some : parts) all.insert(all.end(), some.begin(), some.end());
    sortVoxels(all);
    return all;
}

/// The voxels of each region, sorted.
inline std::vector<Voxels> voxelsOf(
    const std::vector<VoxelRegion>& regions, const SampleLevel& object)
{
    std::vector<Voxels> all;
    for (const VoxelRegion& region : regions) {
        Voxels voxels;
        for (const auto& part : region) {
            const Voxels some = voxelsOf(part.mask, object.origin(part.leaf));
            voxels.insert(voxels.end(), some.begin(), some.end());
        }
        sortVoxels(voxels);
        all.push_back(voxels);
    }
    return all;
}

/// @return what each ball holds of its children's regions.
inline std::vector<Voxels> heldBelow(const std::vector<ExactSphere>& balls,
    const std::vector<int32_t>& parents, const std::vector<Voxels>& regions)
{
    std::vector<Voxels> held(balls.size());
    for (std::size_t c = 0; c < regions.size(); ++c) {
        const int32_t parent = parents.at(c);
        for (const Coord& v : regions[c]) {
            if (holds(balls.at(parent), v)) held[parent].push_back(v);
        }
    }
    for (Voxels& voxels : held) sortVoxels(voxels);
    return held;
}

} // namespace spheretree_test
