// SPDX-License-Identifier: Apache-2.0
/// @file detail/MaskNodes.h
/// @brief The nodes of a mask tree, by the cubes they stand for.

#pragma once

#include <openvdb/openvdb.h>

namespace openvdb_spheretree {
namespace detail {

using RootCellNode = openvdb::MaskTree::RootNodeType::ChildNodeType; ///< 4096^3 voxels
using BlockNode = RootCellNode::ChildNodeType;                       ///< 128^3
using LeafNode = openvdb::MaskTree::LeafNodeType;                    ///< 8^3

} // namespace detail
} // namespace openvdb_spheretree
