// SPDX-License-Identifier: Apache-2.0
/// @file Masks.h
/// @brief The trees of voxel sets and their nodes, compiled once (Masks.cc) rather than in every file that uses them.
///
/// OpenVDB's library holds the code of its grids of numbers, but not that of masks. Each file that
/// makes or copies a mask would compile all virtual functions of its tree: ten seconds.

#pragma once

#include "MaskTree.h"

namespace openvdb_spheretree::detail {

using MaskRoot = openvdb::MaskTree::RootNodeType;
using UpperNode = MaskRoot::ChildNodeType;        ///< 4096^3 voxels
using LowerNode = UpperNode::ChildNodeType;       ///< 128^3
using LeafNode = openvdb::MaskTree::LeafNodeType; ///< 8^3
using BoolRoot = openvdb::BoolTree::RootNodeType;
using BoolUpperNode = BoolRoot::ChildNodeType;
using BoolLowerNode = BoolUpperNode::ChildNodeType;

/// Calls f(box) for every active tile of a tree, of whatever size; box is inclusive.
template <typename TreeType, typename F>
void forEachTile(const TreeType& tree, const F& f)
{
    auto tile = tree.cbeginValueOn();
    tile.setMaxDepth(TreeType::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        openvdb::CoordBBox box;
        tile.getBoundingBox(box);
        f(box);
    }
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
