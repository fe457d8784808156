// SPDX-License-Identifier: Apache-2.0
/// @file MaskNodes.h
/// @brief The nodes of a mask tree, by the cubes they stand for.

#pragma once

#include "Masks.h"

namespace openvdb_spheretree::detail {

using UpperNode = openvdb::MaskTree::RootNodeType::ChildNodeType; ///< 4096^3 voxels
using LowerNode = UpperNode::ChildNodeType;                       ///< 128^3
using LeafNode = openvdb::MaskTree::LeafNodeType;                 ///< 8^3

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
