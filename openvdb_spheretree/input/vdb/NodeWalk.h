// SPDX-License-Identifier: Apache-2.0
/// @file NodeWalk.h
/// @brief The nodes of a grid as a `.vdb` has them: root, internal nodes and the masks of the leaves,
/// depth first.

#pragma once

#include "ByteWindow.h"
#include "ValueBlock.h"

#include <openvdb/Types.h> // Coord

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// The nodes of a grid below its root.
struct GridNodes {
    int64_t upper = 0, lower = 0;       ///< internal ones: of 32^3 and of 16^3 children
    std::vector<openvdb::Coord> leaves; ///< origins, in the order in which their values follow
};

/// @return the bytes that OpenVDB takes for them, without the values of the leaves.
double bytesOf(const GridNodes& nodes, const ValueType& type);

/// @brief Walk over all nodes of a grid.
/// @throw openvdb::IoError if a node is not where a node can be, or the order is another than
///        OpenVDB's: it would give values to other leaves than they belong to.
GridNodes takeNodes(ByteWindow& window, const BlockFormat& format);

} // namespace openvdb_spheretree::detail
