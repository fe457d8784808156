// SPDX-License-Identifier: Apache-2.0
/// @file NodeWalk.h
/// @brief The nodes of a grid as a `.vdb` has them: root, internal nodes and the masks of the leaves,
/// depth first.

#pragma once

#include "ByteWindow.h"
#include "ValueBlock.h"

#include <openvdb/Types.h> // Coord

#include <vector>

namespace openvdb_spheretree::detail {

/// @brief Walk over all nodes of a grid.
/// @return the origins of the leaves, in the order in which their values follow.
/// @throw openvdb::IoError if a node is not where a node can be, or the order is another than
///        OpenVDB's: it would give values to other leaves than they belong to.
std::vector<openvdb::Coord> takeNodes(ByteWindow& window, const BlockFormat& format);

} // namespace openvdb_spheretree::detail
