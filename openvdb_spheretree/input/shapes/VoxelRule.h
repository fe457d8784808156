// SPDX-License-Identifier: Apache-2.0
/// @file VoxelRule.h
/// @brief A set of voxels given by a rule, and the tree of it: tiles where a node is full, leaf
/// nodes made as masks, nothing where there is nothing.
///
/// 1. `tilesAndBlocks`: nodes of 4096^3 and of 128^3 voxels that are full become tiles; those of
///    128^3 that may hold a part of the shape are listed;
/// 2. these are painted in parallel, each by one call of VoxelRule::paint();
/// 3. `hang`: those that have got something go into the tree, in their order.
///
/// Cost: a call of filling() for every node of the box, one of leaf() for every leaf that may be
/// neither full nor empty. Memory: the tree, and 20 bytes a node of 128^3.

#pragma once

#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {
namespace detail {

using BoolLeafNode = openvdb::BoolTree::LeafNodeType;                ///< 8^3 voxels
using BoolCellNode = openvdb::BoolTree::RootNodeType::ChildNodeType; ///< 4096^3
using BoolBlockNode = BoolCellNode::ChildNodeType;                   ///< 128^3

/// How much of a cube is on.
enum class Filling {
    None,
    Part, ///< or not known
    All
};

/// A shape. Asked by many threads at once; all coordinates are voxels.
class VoxelRule {
public:
    virtual ~VoxelRule() = default;

    /// @return a box that holds the whole shape; inclusive.
    virtual openvdb::CoordBBox box() const = 0;

    /// @param cube  a node: of 4096^3, 128^3 or 8^3 voxels, reaching out of box() perhaps
    virtual Filling filling(const openvdb::CoordBBox& cube) const;

    /// Adds the shape's leaves and tiles to @a block, which is empty.
    virtual void paint(BoolBlockNode& block) const = 0;
};

/// One of which every leaf can be told by itself.
class LeafwiseRule : public VoxelRule {
public:
    /// @return the voxels of the leaf at @a origin; those beyond box() do not count.
    virtual LeafMask leaf(const openvdb::Coord& origin) const = 0;

    void paint(BoolBlockNode& block) const final;
};

/// A new leaf node, unless the mask is empty.
void addLeaf(BoolBlockNode& block, const openvdb::Coord& origin, const LeafMask& mask);

/// @return the tree of the shape's voxels: on and true; the background is off and false.
/// @throw Interrupted if the interrupter (may be null) said so
openvdb::BoolTree::Ptr treeOf(const VoxelRule& shape, openvdb::util::NullInterrupter* interrupter);

} // namespace detail
} // namespace openvdb_spheretree
