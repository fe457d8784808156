// SPDX-License-Identifier: Apache-2.0
/// @file TightLevels.h
/// @brief From balls and cuts of a forest to the nodes of a SphereTree.

#pragma once

#include <openvdb_spheretree/voxel/MedialBall.h>
#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/tight/merge/MergeForest.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <vector>

namespace openvdb_spheretree {
namespace tight {

/// The balls of one level.
struct TightLevel {
    std::vector<ExactSphere> balls;
    std::vector<int32_t> parent; ///< in the next coarser level; empty for the coarsest
    /// Per ball, the digital ball that it is; empty where they are none.
    std::vector<MedialBall> digital;
};

/// @return the nodes of the cut with @a count balls, ascending.
std::vector<int32_t> cutOf(const std::vector<ForestNode>& forest, int64_t count);

/// @return the balls of the cut with @a count balls.
std::vector<ExactSphere> ballsOfCut(const std::vector<ForestNode>& forest, int64_t count);

/// Drops balls of @a level that are the parent of none of @a finer: no chain needs them.
void dropChildless(TightLevel& level, TightLevel& finer);

/// @return the ball of @a level that @a ball protrudes from least; empty ones do not count.
int32_t leastProtruding(const ExactSphere& ball, const std::vector<ExactSphere>& level);

/// @param counts  finest first, falling, none above the number of leaf balls
/// @param leafBalls  the first nodes of the forest, as medial balls
/// @return a level for each count. A node's parent is its ancestor in the coarser cut. A ball without
/// one, which no voxel needs there, goes to the ball that it protrudes from least.
std::vector<TightLevel> levelsOf(const std::vector<ForestNode>& forest,
    const std::vector<int64_t>& counts, const std::vector<MedialBall>& leafBalls);

/// @brief Make the levels those of @a tree, which has none: all but its stored radii.
/// @param levels  finest first; flat objects are flat along z
void appendLevels(const std::vector<TightLevel>& levels, SphereTree& tree);

/// @return the forest in the form of SphereTree, without stored radii.
SphereCuts cutsOf(const std::vector<ForestNode>& forest, int flatAxis);

} // namespace tight
} // namespace openvdb_spheretree
