// SPDX-License-Identifier: Apache-2.0
/// @file NodeBytes.h
/// @brief What the nodes of a mask take, before it is made.

#pragma once

#include "Masks.h"

namespace openvdb_spheretree::detail {

/// What one can do where nodes take too much.
constexpr const char* kNodeRemedy = "use a larger voxel, or split the object";

/// @return the bytes of a mask, or a tree of bools, with the nodes of @a tree: 270 KB for each
///         4096^3 that has any, 34 KB for each 128^3, and 100 bytes for each leaf. Cost: O(nodes
///         that are no leaves).
template <typename TreeType>
double nodeBytes(const TreeType& tree)
{
    const auto counts = tree.nodeCount(); // leaves first
    return double(counts[0]) * sizeof(LeafNode) + double(counts[1]) * sizeof(LowerNode)
        + double(counts[2]) * sizeof(UpperNode);
}

} // namespace openvdb_spheretree::detail
