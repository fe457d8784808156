// SPDX-License-Identifier: Apache-2.0
/// @file PartSelection.h
/// @brief The largest part of a set of voxels; a set with its cavities filled.
///
/// Parts hang together by faces, edges or corners (26-connected). A cavity is background that no path of
/// voxels sharing faces (6-connected) joins with infinity: as LevelTopology.h counts them.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {

/// @return the part of the most voxels; of several, the one with the voxel that comes first by its leaf, x
///         first. Empty if @a voxels is.
/// @throw Interrupted if the interrupter (may be null) said so
/// Cost: linear in leaves, tiles counted as the leaves they stand for.
openvdb::SharedPtr<openvdb::MaskTree> largestPart(
    const openvdb::MaskTree& voxels, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return @a voxels and all their cavities; what was empty space between leaves is tiles.
/// @throw Interrupted if the interrupter (may be null) said so
/// Cost: the same, and leaf-sized tiles in cavities.
openvdb::SharedPtr<openvdb::MaskTree> withCavitiesFilled(
    const openvdb::MaskTree& voxels, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
