// SPDX-License-Identifier: Apache-2.0
/// @file QuerySamples.h
/// @brief What tests of questions share: small trees of every kind, poses, and answers by brute
/// force over all pairs of leaf spheres, in doubles. Shares no code with the library's traversal.

#pragma once

#include "support/RandomObjects.h"

#include <openvdb_spheretree/query/QueryTree.h>
#include <openvdb_spheretree/query/RigidTransform.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <string>
#include <vector>

namespace spheretree_test {

using openvdb_spheretree::Exactness;
using openvdb_spheretree::QueryTree;
using openvdb_spheretree::RigidTransform;
using openvdb_spheretree::SphereTree;

/// A tree, its object, and what it is asked with.
struct QuerySample {
    std::string name;
    Voxels voxels;
    SphereTree tree;
    openvdb_spheretree::QueryTreeSettings settings = {};
};

/// Tight trees with both covers, extended ones and those of other budgets, over random objects, a
/// single voxel, two far voxels, and a row of voxels.
const std::vector<QuerySample>& querySamples();

/// Trees of every other kind that has answers: reversible ones, those centered on miniballs, with leaves that are given, of
/// coarser levels, without padding, scaled, flat, inside the object, and spheres without any.
const std::vector<QuerySample>& otherQuerySamples();

/// One tree of @a settings of these voxels.
QuerySample querySample(const std::string& name, const Voxels& voxels,
    const openvdb_spheretree::SphereTreeSettings& settings);

/// The tree of queries of a sample, as it is asked, but for its exactness.
QueryTree makeQueryTree(const QuerySample& sample, Exactness exactness);

/// The sample of that name.
const QuerySample& querySample(const std::string& name);

/// Uniform in all directions.
RigidTransform randomRotation(Random& random);
double uniform(Random& random, double low, double high);
openvdb::Vec3d randomDirection(Random& random);

/// A leaf sphere in the world, as files have it.
struct WorldBall {
    openvdb::Vec3d center;
    double radius;
};

/// The leaf spheres of the finest level as they are stored, moved by @a pose.
std::vector<WorldBall> leafBalls(const SphereTree& tree, const RigidTransform& pose = {});
/// Those of the level that is asked, scaled as well.
std::vector<WorldBall> leafBalls(const QuerySample& sample, const RigidTransform& pose = {});

/// @return |a - b| less both radii.
double gap(const WorldBall& a, const WorldBall& b);
/// @return the smallest gap of two balls.
double smallestGap(const std::vector<WorldBall>& a, const std::vector<WorldBall>& b);

} // namespace spheretree_test
