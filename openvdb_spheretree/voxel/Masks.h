// SPDX-License-Identifier: Apache-2.0
/// @file Masks.h
/// @brief The trees of voxel sets and their nodes, compiled once (Masks.cc) rather than in every file that uses them.
///
/// OpenVDB's library holds the code of its grids of numbers, but not that of masks. Each file that
/// makes or copies a mask would compile all virtual functions of its tree: ten seconds.

#pragma once

#include "MaskTree.h"

#include <cstdint>

namespace openvdb_spheretree::detail {

using MaskRoot = openvdb::MaskTree::RootNodeType;
using UpperNode = MaskRoot::ChildNodeType;        ///< 4096^3 voxels
using LowerNode = UpperNode::ChildNodeType;       ///< 128^3
using LeafNode = openvdb::MaskTree::LeafNodeType; ///< 8^3
using BoolRoot = openvdb::BoolTree::RootNodeType;
using BoolUpperNode = BoolRoot::ChildNodeType;
using BoolLowerNode = BoolUpperNode::ChildNodeType;

/// Calls f(box) for the active tiles of a node and of those below it, but not of leaves.
/// Recursion: as deep as the tree, three nodes.
template <typename NodeType, typename F>
void forEachTileOf(const NodeType& node, const F& f)
{
    using ChildType = typename NodeType::ChildNodeType;
    auto tile = node.cbeginValueOn();
    auto child = node.cbeginChildOn();
    while (tile || child) {
        if (tile && !(child && child.getCoord() < tile.getCoord())) {
            f(openvdb::CoordBBox::createCube(tile.getCoord(), ChildType::DIM));
            ++tile;
            continue;
        }
        if constexpr (ChildType::LEVEL > 0) forEachTileOf(*child, f);
        ++child;
    }
}

/// Calls f(box) for every active tile of a tree, of whatever size, in the order of OpenVDB's
/// iterators; box is inclusive. (Those take a step along the root for each of its nodes before, at
/// every one: with 10,000 nodes of 4096^3 voxels that was three quarters of a build.)
template <typename TreeType, typename F>
void forEachTile(const TreeType& tree, const F& f)
{
    forEachTileOf(tree.root(), f);
}

/// @return how many leaf nodes a tree has, those among them that its tiles stand for.
inline int64_t leafNodesOf(const openvdb::MaskTree& tree)
{
    auto count = int64_t(tree.leafCount());
    forEachTile(tree, [&](const openvdb::CoordBBox& tile) {
        const int64_t side = (int64_t(tile.max()[0]) - tile.min()[0] + 1) / LeafNode::DIM;
        count += side * side * side;
    });
    return count;
}

} // namespace openvdb_spheretree::detail

// Masks.cc, which holds the code, defines this as `template`. Root nodes are left out: OpenVDB 10.0 has
// a member in them that does not compile, and is never called.
#ifndef SPHERETREE_MASK_TEMPLATE
#define SPHERETREE_MASK_TEMPLATE extern template
#endif
SPHERETREE_MASK_TEMPLATE class openvdb::tree::InternalNode<openvdb_spheretree::detail::LeafNode, 4>;
SPHERETREE_MASK_TEMPLATE class openvdb::tree::InternalNode<openvdb_spheretree::detail::LowerNode,
    5>;
SPHERETREE_MASK_TEMPLATE class openvdb::tree::Tree<openvdb_spheretree::detail::MaskRoot>;
SPHERETREE_MASK_TEMPLATE class openvdb::tree::InternalNode<openvdb::BoolTree::LeafNodeType, 4>;
SPHERETREE_MASK_TEMPLATE class openvdb::tree::InternalNode<
    openvdb_spheretree::detail::BoolLowerNode, 5>;
SPHERETREE_MASK_TEMPLATE class openvdb::tree::Tree<openvdb_spheretree::detail::BoolRoot>;
