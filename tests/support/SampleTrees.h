// SPDX-License-Identifier: Apache-2.0
/// @file SampleTrees.h
/// @brief Sphere-trees written by hand, for tests of what stores and prints them. Every field has a
/// value of its own, so that a field forgotten or mixed up shows. They cover no object.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <cstdint>

namespace spheretree_test {

using openvdb_spheretree::SphereTree;
using openvdb_spheretree::SphereTreeLevel;

/// A node whose other numbers follow from its radius, each a little different.
void addNode(SphereTree& tree, const openvdb::Vec3d& center, const openvdb::Coord& ijk,
    int32_t radiusSq, int32_t parent);

/// Starts a level below the ones before; nodes added after the call belong to it.
void addLevel(SphereTree& tree, int32_t nodes, int64_t pyramidVoxels);

/// One voxel at (-3, 4, 5): a single ball of radius 0.
SphereTree oneVoxelTree();

void fillDescription(SphereTree& tree);

/// Three levels of 1, 2 and 5 nodes: negative centres and such between voxels, one centre on all
/// levels, an error known, one unknown, one never asked for, one topology, a DAG, and no setting at
/// its default.
SphereTree sampleTree();

/// Cuts of 1 to 4 spheres: two leaves merge, then a leaf ends that owes nothing, then the rest
/// merges.
void addCuts(SphereTree& tree);

/// Two levels of 1 and 3 nodes in 16ths of a voxel, of which one is a digital ball, with cuts.
SphereTree tightSampleTree();

/// Levels of n, n / 10, ... 1 nodes at random half-voxel centres in a box of some 200 voxels.
SphereTree randomTree(int32_t n, unsigned seed);

/// The nodes of one level, as a tree whose nodes are all roots.
SphereTree oneLevelOf(const SphereTree& tree, int number);

void expectSameDescription(const SphereTree& a, const SphereTree& b);

/// Every bit of the map, where Transform::operator== has a tolerance.
void expectSameTransform(const openvdb::math::Transform& a, const openvdb::math::Transform& b);

/// Identical in every field.
void expectSameTree(const SphereTree& a, const SphereTree& b);

} // namespace spheretree_test
