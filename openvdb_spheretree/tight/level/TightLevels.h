// SPDX-License-Identifier: Apache-2.0
/// @file TightLevels.h
/// @brief From balls and cuts of a forest to the nodes of a SphereTree.

#pragma once

#include <openvdb_spheretree/voxel/MedialBall.h>
#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/tight/merge/MergeForest.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <vector>

namespace openvdb_spheretree::tight {

/// The balls of one level.
struct TightLevel {
    std::vector<ExactSphere> balls;
    std::vector<int32_t> parent; ///< in the next coarser level; empty for the coarsest
    /// The same as digital balls if they are all leaf balls; else empty.
    std::vector<MedialBall> digital;
};

/// @return the balls of all levels.
std::vector<ExactSphere> allBalls(const std::vector<TightLevel>& levels);

/// @return the nodes of the cut with @a count balls, ascending.
std::vector<int32_t> cutOf(const std::vector<ForestNode>& forest, int64_t count);

/// @return the balls of the nodes of that cut.
std::vector<ExactSphere> ballsOfCut(const std::vector<ForestNode>& forest, int64_t count);

/// Drops the balls of @a level that have no child in @a finer: no chain needs them.
void dropChildless(TightLevel& level, TightLevel& finer);

/// Gives the children of empty balls of @a level to others that are near. No chain needs them.
void adoptOrphans(TightLevel& finer, const std::vector<ExactSphere>& level);

/// @return the ball of @a level out of which @a ball reaches least; empty ones do not count.
int32_t leastProtruding(const ExactSphere& ball, const std::vector<ExactSphere>& level);
/// The same, but it looks only at those that are near.
int32_t leastProtruding(
    const ExactSphere& ball, const std::vector<ExactSphere>& level, const BallGrid& grid);
/// @return the one of those of @a level that are nearest. For balls that no chain needs: it does
/// not matter which, and levels may be large.
int32_t anyNear(
    const ExactSphere& ball, const std::vector<ExactSphere>& level, const BallGrid& grid);

/// @param counts     finest first, falling, none above the number of leaf balls
/// @param digital    the first nodes of the forest as digital balls; empty if they are none
/// @return a level for each count. A node's parent is its ancestor in the coarser cut. A node
/// without one, which no voxel needs there, gets the ball out of which it reaches least.
std::vector<TightLevel> levelsOf(const std::vector<ForestNode>& forest,
    const std::vector<int64_t>& counts, const std::vector<MedialBall>& digital);

/// @brief Appends the levels to @a tree, which has none, without stored radii.
/// @param levels  finest first; flat objects are flat along z
void appendLevels(const std::vector<TightLevel>& levels, SphereTree& tree);

/// @return the levels that were appended to @a tree. Balls of the finest level are not known as
/// digital ones.
std::vector<TightLevel> levelsOf(const SphereTree& tree);

/// @return the forest as cuts of a SphereTree, without stored radii.
SphereCuts cutsOf(const std::vector<ForestNode>& forest, int flatAxis);

} // namespace openvdb_spheretree::tight
