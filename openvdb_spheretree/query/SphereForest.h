// SPDX-License-Identifier: Apache-2.0
/// @file SphereForest.h
/// @brief Nodes with spheres and children, before they become blocks: what a tree of queries is made of.
///
/// 1. makeQueryTree() takes the nodes from a sphere-tree;
/// 2. `divideWideNodes()`: no node has more children than a block has lanes;
/// 3. `blocksOf()`: nodes become lanes (SphereBlocks.h), and children of children are pulled up
///    while lanes are free.
///
/// A node that comes in between holds the spheres of its children: a chain of spheres that hold a
/// voxel stays one, and what held its leaf balls still does.

#pragma once

#include "SphereBlocks.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

struct ForestNode {
    openvdb::Vec3d center{0, 0, 0};
    double radius = 0;
    int32_t leaf = -1;             ///< number of the leaf; -1 of an inner node
    std::vector<int32_t> children; ///< places in the forest; empty of a leaf
};

struct SphereForest {
    std::vector<ForestNode> nodes;
    std::vector<int32_t> roots;
};

/// A sphere that holds spheres: its center is nearly that of the smallest one (M. Badoiu and K. L.
/// Clarkson, "Smaller core-sets for balls", SODA 2003: steps towards the farthest sphere, ever
/// shorter), its radius rounded up.
ForestNode enclosingSphere(const std::vector<ForestNode>& nodes, const std::vector<int32_t>& of);

/// @brief Nodes of more than kBlockWidth children, and such a number of roots, get inner nodes in
/// between: the children are divided in two, again and again, where the sum of count times squared
/// size of both boxes is smallest (the surface area heuristic of ray tracing, of spheres).
/// Cost: O(n log^2 n) of n children.
void divideWideNodes(SphereForest& forest);

/// @brief Lays out a forest: every inner node becomes a lane, or is opened into that of its
/// parent, the largest first.
/// @param forest     divided; has a leaf
/// @param leafCount  leaves are numbered 0 to leafCount - 1, each there once
/// @throw openvdb::ValueError if it is deeper than kMostDepth
SphereBlocks blocksOf(const SphereForest& forest, int32_t leafCount);

} // namespace openvdb_spheretree::detail
