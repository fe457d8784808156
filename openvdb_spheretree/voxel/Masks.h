// SPDX-License-Identifier: Apache-2.0
/// @file Masks.h
/// @brief The trees of voxel sets, compiled once (Masks.cc) rather than in every file that uses them.
///
/// OpenVDB's library holds the code of its grids of numbers, but not that of masks. Each file that
/// makes or copies a mask would compile all virtual functions of its tree: ten seconds.

#pragma once

#include "MaskTree.h"

namespace openvdb_spheretree::detail {

using MaskRoot = openvdb::MaskTree::RootNodeType;
using MaskUpper = MaskRoot::ChildNodeType;
using MaskLower = MaskUpper::ChildNodeType;
using BoolRoot = openvdb::BoolTree::RootNodeType;
using BoolUpper = BoolRoot::ChildNodeType;
using BoolLower = BoolUpper::ChildNodeType;

} // namespace openvdb_spheretree::detail

// Masks.cc, which holds the code, defines this as `template`. Root nodes are left out: OpenVDB 10.0 has
// a member in them that does not compile, and is never called.
#ifndef SPHERETREE_MASK_TEMPLATE
#define SPHERETREE_MASK_TEMPLATE extern template
#endif
SPHERETREE_MASK_TEMPLATE class openvdb::tree::InternalNode<openvdb::MaskTree::LeafNodeType, 4>;
SPHERETREE_MASK_TEMPLATE class openvdb::tree::InternalNode<openvdb_spheretree::detail::MaskLower,
    5>;
SPHERETREE_MASK_TEMPLATE class openvdb::tree::Tree<openvdb_spheretree::detail::MaskRoot>;
SPHERETREE_MASK_TEMPLATE class openvdb::tree::InternalNode<openvdb::BoolTree::LeafNodeType, 4>;
SPHERETREE_MASK_TEMPLATE class openvdb::tree::InternalNode<openvdb_spheretree::detail::BoolLower,
    5>;
SPHERETREE_MASK_TEMPLATE class openvdb::tree::Tree<openvdb_spheretree::detail::BoolRoot>;
