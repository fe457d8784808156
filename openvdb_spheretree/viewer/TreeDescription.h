// SPDX-License-Identifier: Apache-2.0
/// @file TreeDescription.h
/// @brief What the page says of a tree in words and single numbers.

#pragma once

#include "ObjectSurface.h"
#include <openvdb_spheretree/tree/SphereTree.h>

#include <string>

namespace openvdb_spheretree::detail {

/// @return JSON that may stand in an element of a page: it has no '<', whatever the names are.
/// @param surface  null if there is none
/// @param missing  why
std::string treeDescription(
    const SphereTree& tree, const ObjectSurface* surface, const std::string& missing);

} // namespace openvdb_spheretree::detail
