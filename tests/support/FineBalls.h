// SPDX-License-Identifier: Apache-2.0
/// @file FineBalls.h
/// @brief For tests of the parts of tight trees: balls in 1/16 voxel by their definition, and what
/// they are asked about.

#pragma once

#include "CoreStages.h"
#include "RandomObjects.h"

#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/voxel/LeafMask.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace spheretree_test {

using openvdb_spheretree::ExactSphere;
using openvdb_spheretree::LeafMask;
using openvdb_spheretree::tight::SampledObject;

bool holds(const ExactSphere& ball, const Coord& voxel);

/// sqrt(D) >= sqrt(a) + sqrt(b), in integers.
bool atLeastSum(__int128 D, __int128 a, __int128 b);

__int128 centersApartSq(const ExactSphere& a, const ExactSphere& b);

/// All of @a held, not its voxels alone.
bool contains(const ExactSphere& ball, const ExactSphere& held);

/// The smallest squared radius around the centre of @a ball that holds these voxels; -1 for none.
int64_t neededRadiusSq(const ExactSphere& ball, const Voxels& voxels);

/// @param low, high  of the centre, voxels
/// @param radius     at most, voxels
ExactSphere randomBall(Random& random, int low, int high, int radius);

std::vector<ExactSphere> randomBalls(int count, Random& random, int low, int high, int radius);

/// The same balls in 1/16 voxel.
std::vector<ExactSphere> fineBalls(const std::vector<openvdb_spheretree::MedialBall>& balls);

SampledObject sampled(const Voxels& voxels);

bool contains(const Voxels& voxels, const Coord& voxel);

/// How many voxels balls hold together that are not the object's.
int64_t excess(const std::vector<ExactSphere>& balls, const Voxels& object);

Voxels voxelsOf(const LeafMask& mask, const Coord& origin);

/// Whether balls around any place that hold these points hold all the voxels: asked at some places.
/// The points must be some of the voxels.
testing::AssertionResult standFor(const Voxels& points, const Voxels& voxels, Random& random);

/// Calls body() with every target of Highway that this machine has.
void forEachTarget(const std::function<void()>& body);

} // namespace spheretree_test
