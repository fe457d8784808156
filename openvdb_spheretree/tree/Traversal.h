// SPDX-License-Identifier: Apache-2.0
/// @file Traversal.h
/// @brief A tree from the root down: the children of its nodes, and a visit of those of interest.
///
/// A tree stores parents. What goes down asks for the children once, as rows:
///
///     const CompressedRows rows = children(tree);
///     visitSpheres(tree, rows, [&](int32_t id) { return holds(tree, id, point); });
///
/// Whether a node may be left out with all that is below it depends on the tree. Each node of a
/// tight tree with cover=balls, and of an extended one, contains the leaf balls below it. In other
/// trees a point in a leaf ball need not be in the spheres above; but each voxel center of the
/// object has, in a tight tree, one chain of nodes at least that all hold it, down to level 0.

#pragma once

#include "SphereTree.h"
#include <openvdb_spheretree/base/CompressedRows.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

/// @return the children of every node, by id: row i holds those of node i, ascending.
/// @throw openvdb::ValueError if a parent is no node of the tree. Cost: O(nodes).
CompressedRows children(const SphereTree& tree);

/// @brief Calls @a descend for the nodes of the top level, by id, and for the children of each node
/// that it is true of; a node's children come right after it.
/// @param children  those of the tree
/// @param descend   bool(int32_t id): whether to go on below node id
template <typename Descend>
void visitSpheres(const SphereTree& tree, const CompressedRows& children, const Descend& descend)
{
    if (tree.levels.empty()) return;
    std::vector<int32_t> open; // the last is next; at most the children of one chain of nodes
    for (int32_t id = tree.root().end; id-- > tree.root().begin;) open.push_back(id);
    while (!open.empty()) {
        const int32_t id = open.back();
        open.pop_back();
        if (!descend(id)) continue;
        const NodeSpan below = children[id];
        for (std::size_t i = below.size(); i-- > 0;) open.push_back(below[i]);
    }
}

/// @brief The same for a single visit. Cost: O(nodes), for the children.
template <typename Descend>
void visitSpheres(const SphereTree& tree, const Descend& descend)
{
    visitSpheres(tree, children(tree), descend);
}

} // namespace openvdb_spheretree
