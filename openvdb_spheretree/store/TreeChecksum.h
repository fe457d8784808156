// SPDX-License-Identifier: Apache-2.0
/// @file TreeChecksum.h
/// @brief The checksum that each grid of a stored tree carries, over all that the format gives it.
///
/// It is text in metadata: `crc32`, then for each part its name and CRC-32, as `radius=0a1b2c3d`.
/// Parts are the attributes, with the values of all nodes in the order of ids; the edges in their
/// order; and the metadata. The place in the world has a text of its own, `transform=0a1b2c3d`, so
/// that who moves a tree on purpose can remove it and keep the rest. docs/formats.md says what bytes
/// are summed.
///
/// Sums are taken of what is stored, not of how: a file that another program saved again, with another
/// codec or with points in another order, still has them. The grid's name, and attributes, groups
/// and metadata of others (keys that do not start with `spheretree_`) are not part of them.
/// `id`, `level` and the groups have none: ids are 0 to n - 1, levels follow from them and the
/// metadata, and groups from levels. They are compared.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <openvdb/Grid.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

/// A part of a grid by the name that it has in the checksum, and the CRC-32 of its content.
struct PartChecksum {
    std::string part;
    uint32_t crc;
};

/// @name The parts of the three grids, but for metadata and transform. Linear; all threads
/// @throw Interrupted
/// @{
std::vector<PartChecksum> nodeChecksums(
    const SphereTree& tree, openvdb::util::NullInterrupter* interrupter);
std::vector<PartChecksum> edgeChecksums(
    const std::vector<DagEdge>& edges, openvdb::util::NullInterrupter* interrupter);
std::vector<PartChecksum> cutsChecksums(
    const SphereCuts& cuts, openvdb::util::NullInterrupter* interrupter);
/// @}

/// @brief Puts the checksum of a grid into its metadata, all else of which is there, as is the
/// transform.
void writeChecksum(openvdb::GridBase& grid, const std::vector<PartChecksum>& content);

/// @name Whether a grid that has a checksum is as it was written
/// @throw openvdb::IoError naming the parts that are not; openvdb::ValueError if the checksum itself
///        is not there, or of another type
/// @{
void verifyDescription(const openvdb::GridBase& grid); ///< metadata and transform
void verifyContent(const openvdb::GridBase& grid, const std::vector<PartChecksum>& content);
/// @}

} // namespace openvdb_spheretree::detail
