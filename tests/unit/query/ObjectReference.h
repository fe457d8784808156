// SPDX-License-Identifier: Apache-2.0
/// @file ObjectReference.h
/// @brief Answers of points and rays by brute force, in doubles: over all leaf spheres of a tree,
/// and over all voxel cubes of its object. Shares no code with the library's traversal.

#pragma once

#include "QuerySamples.h"

#include <openvdb/math/Vec3.h>

#include <vector>

namespace spheretree_test {

/// The closed cube of a voxel, in the world of its sample.
struct WorldCube {
    openvdb::Vec3d low, high;
};

std::vector<WorldCube> cubes(const QuerySample& sample);

/// @return the smallest |point - center| - radius.
double distanceToBalls(const openvdb::Vec3d& point, const std::vector<WorldBall>& balls);
/// @return 0 inside.
double distanceToCubes(const openvdb::Vec3d& point, const std::vector<WorldCube>& cubes);

/// The points origin + t direction, t in [near, far].
struct PlainRay {
    openvdb::Vec3d origin, direction;
    double near, far;
};

/// @return the smallest t of a point in a ball, infinity without one.
/// @param grown  world units that all balls are larger by
double entryOfBalls(const PlainRay& ray, const std::vector<WorldBall>& balls, double grown = 0);
double entryOfCubes(const PlainRay& ray, const std::vector<WorldCube>& cubes);

/// A point around a sample: in its box made larger by half, or near a leaf sphere's surface.
openvdb::Vec3d randomPoint(Random& random, const std::vector<WorldBall>& balls);

/// @return the farthest a point of a ball is from the middle of all centers.
double sizeOf(const std::vector<WorldBall>& balls);

/// The tree somewhere else, with its axes in another order: x of it is y of @a tree, and so on.
SphereTree turnedTree(SphereTree tree, const openvdb::Vec3d& offset);

} // namespace spheretree_test
