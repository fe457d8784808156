// SPDX-License-Identifier: Apache-2.0
/// @file PointKernel.h
/// @brief Kernels of points and balls: the nearest leaf, whether any is met, and whether a digital
/// ball holds a voxel.
///
/// All of them take lists: one call, many questions. Coordinates are those of the blocks. Results
/// are the same for every vector target. Tests: TestPointQuery.cc, TestDigitalLeaves.cc,
/// TestSphereDistances.cc.

#pragma once

#include "BlockHit.h"
#include "SphereBlocks.h"
#include <openvdb_spheretree/voxel/MedialBall.h>

#include <openvdb/math/Coord.h>

#include <cstddef>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// A ball around a tree: what is farther from it than `reach` has no question to the tree.
struct BallAround {
    float x, y, z, reach;
};
constexpr std::size_t kMostFiltered = 32; ///< spheres at a time

/// @param spheres  x, y, z, radius of each; not aligned
/// @param count    kMostFiltered at most
/// @return a bit for each sphere of radius 0 or more whose surface may be within reach; and for each with a number
///        that is not finite, so that the caller looks at it.
uint32_t spheresWithin(const BallAround& around, const float* spheres, std::size_t count);

struct PointQuestion {
    float x, y, z;
    float limit; ///< only leaves whose spheres are nearer count: below 1e15
};

/// @param hits  receives the leaf with the smallest |point - center| - radius of each
void nearestLeaves(
    const SphereBlocks& tree, const PointQuestion* points, std::size_t count, BlockHit* hits);

/// @return the first ball that meets a leaf sphere, within the rounding of floats; count if none
///        does
/// @param blocks  receives how many were tested
std::size_t firstBallThatMeets(
    const SphereBlocks& tree, const FloatSphere* balls, std::size_t count, int64_t& blocks);

/// @param ball    holds the center of the voxel @a q
/// @param leaves  one a leaf, by number
/// @return whether the digital ball of a leaf whose sphere the ball meets holds @a q
bool isInDigitalBall(const SphereBlocks& tree, const FloatSphere& ball, const MedialBall* leaves,
    const openvdb::Coord& q);

} // namespace openvdb_spheretree::detail
