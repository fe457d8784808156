// SPDX-License-Identifier: Apache-2.0
/// @file GridTemplates.h
/// @brief OpenVDB's grids of numbers, vectors and points, compiled once: as Masks.h has it for masks.
///
/// A file that makes a grid compiles all of its type's virtual functions, seven seconds a type. (OpenVDB's library has
/// them, too, but not all other functions, and its headers do not say so.) With this header in the precompiled one a file
/// does not, and nothing else changes; so few sources include it: those that hold the code, NumberGrids.cc and
/// VectorGrids.cc, and files of the library that call OpenVDB's tools for many types. Its kernels go without it: code that
/// stands in another file is not inlined.

#pragma once

#include "Masks.h"

#include <openvdb/Grid.h>
#include <openvdb/points/PointDataGrid.h>

#ifndef SPHERETREE_NUMBER_TEMPLATE
#define SPHERETREE_NUMBER_TEMPLATE extern template
#endif
#ifndef SPHERETREE_VECTOR_TEMPLATE
#define SPHERETREE_VECTOR_TEMPLATE extern template
#endif

#define SPHERETREE_TREE_TEMPLATE(EXTERN, TREE)                                                     \
    EXTERN class openvdb::tree::InternalNode<TREE::LeafNodeType, 4>;                               \
    EXTERN class openvdb::tree::InternalNode<TREE::RootNodeType::ChildNodeType::ChildNodeType, 5>; \
    EXTERN class openvdb::tree::Tree<TREE::RootNodeType>;                                          \
    EXTERN class openvdb::Grid<TREE>

namespace openvdb_spheretree::detail {

template <typename T>
using TreeOf = typename openvdb::tree::Tree4<T, 5, 4, 3>::Type;

} // namespace openvdb_spheretree::detail

extern template class openvdb::Grid<openvdb::BoolTree>; // Masks.cc
extern template class openvdb::Grid<openvdb::MaskTree>;
SPHERETREE_TREE_TEMPLATE(SPHERETREE_NUMBER_TEMPLATE, openvdb_spheretree::detail::TreeOf<float>);
SPHERETREE_TREE_TEMPLATE(SPHERETREE_NUMBER_TEMPLATE, openvdb_spheretree::detail::TreeOf<double>);
SPHERETREE_TREE_TEMPLATE(SPHERETREE_NUMBER_TEMPLATE, openvdb_spheretree::detail::TreeOf<int32_t>);
SPHERETREE_TREE_TEMPLATE(SPHERETREE_NUMBER_TEMPLATE, openvdb_spheretree::detail::TreeOf<int64_t>);
SPHERETREE_TREE_TEMPLATE(
    SPHERETREE_VECTOR_TEMPLATE, openvdb_spheretree::detail::TreeOf<openvdb::Vec3s>);
SPHERETREE_TREE_TEMPLATE(
    SPHERETREE_VECTOR_TEMPLATE, openvdb_spheretree::detail::TreeOf<openvdb::Vec3d>);
SPHERETREE_TREE_TEMPLATE(
    SPHERETREE_VECTOR_TEMPLATE, openvdb_spheretree::detail::TreeOf<openvdb::Vec3i>);
SPHERETREE_TREE_TEMPLATE(SPHERETREE_VECTOR_TEMPLATE, openvdb::points::PointDataTree);

#undef SPHERETREE_TREE_TEMPLATE
