// SPDX-License-Identifier: Apache-2.0
/// @file SphereCuts.h
/// @brief The continuous tree: one binary forest of spheres that holds a cover of the object for
/// every number of spheres, from the leaves to the root.
///
/// A node is part of the cuts of `first` to `last` spheres. From N to N - 1 spheres, two nodes end
/// and their parent begins, or one node ends that has no voxel left to cover. Every cut keeps the
/// contract of tight trees: each object voxel has a chain of nodes from a leaf up to the cut, each
/// the child of the next, that all hold it.

#pragma once

#include "Spheres.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

struct SphereTree;

/// One entry a node; children stand before their parents, leaves first.
struct SphereCuts {
    /// A parent is -1 for the root, and for nodes that end with no voxel left to cover.
    Spheres spheres;
    std::vector<int32_t> first; ///< fewest spheres of a cut with this node
    std::vector<int32_t> last;  ///< most

    bool empty() const { return spheres.empty(); }
    int32_t size() const { return spheres.size(); }
};

/// @return the nodes of the cut with @a spheres spheres, ascending; O(nodes).
std::vector<int32_t> cutNodes(const SphereCuts& cuts, int64_t spheres);

/// @brief A tree of one level: the cut with at most @a spheres spheres.
/// @throw openvdb::ValueError if the tree has no cuts, or @a spheres is less than 1
SphereTree cutTree(const SphereTree& tree, int64_t spheres);

} // namespace openvdb_spheretree
