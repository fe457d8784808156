// SPDX-License-Identifier: Apache-2.0
/// @file ObjectParts.h
/// @brief The largest part of an object, and an object without cavities: dust around a scan, and bubbles
/// in it, each take spheres.
///
/// As in LevelTopology.h, voxels belong together when they share a corner, and background when it shares
/// a face.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <functional>
#include <vector>

namespace openvdb_spheretree {

/// @return the part of the most voxels, with the object's metadata and transform. Of several, that with the
///         first voxel, by x, then y, then z. Nothing if the object is empty. Tiles stay tiles.
/// @throw as levelTopology()
/// Cost: as levelTopology(), and 24 bytes for each part within a leaf node.
openvdb::SharedPtr<openvdb::BoolGrid> largestPart(
    const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return the object and all background that cannot be reached from far outside by steps across faces,
///         with the object's metadata and transform. Whole empty nodes become tiles. (An object one voxel
///         thick has no cavities: its holes are open to either side.)
/// @throw as levelTopology()
/// Cost: as levelTopology(), and linear in nodes of the object, however large its cavities.
openvdb::SharedPtr<openvdb::BoolGrid> filledCavities(
    const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @name The same of voxels without a place in the world
/// @{
openvdb::SharedPtr<openvdb::MaskTree> largestPart(
    const openvdb::MaskTree& object, openvdb::util::NullInterrupter* interrupter = nullptr);
openvdb::SharedPtr<openvdb::MaskTree> filledCavities(
    const openvdb::MaskTree& object, openvdb::util::NullInterrupter* interrupter = nullptr);
/// @}

/// @param voxels  one of each cavity, in the order of leaf nodes
/// @return whether each of them is to be filled
using CavityChoice = std::function<std::vector<bool>(const std::vector<openvdb::Coord>& voxels)>;

/// @brief The object and those of its cavities that are chosen.
/// @throw, cost: as above
openvdb::SharedPtr<openvdb::MaskTree> filledCavities(const openvdb::MaskTree& object,
    const CavityChoice& choose, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
