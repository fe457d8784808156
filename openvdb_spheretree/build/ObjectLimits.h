// SPDX-License-Identifier: Apache-2.0
/// @file ObjectLimits.h
/// @brief Which objects a tree can be built of, said before any work.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

namespace openvdb_spheretree::detail {

/// @brief Refuse what no tree of these settings can be built of.
/// @param settings  valid ones
/// @throw openvdb::ValueError naming the object, what is wrong with it and what to do: it has no
///        voxels, is wider than kMaxExtent, is not flat though dim = 2, is too wide for its
///        distance or for a tight tree, or lies so near the end of 32-bit coordinates that spheres may reach beyond
/// @return where the voxels of its pyramid are counted from
/// Cost: O(1).
openvdb::Coord requireValidObject(const ObjectInfo& object, const SphereTreeSettings& settings);

/// @brief Refuse an object whose voxels lie so far apart that copies of its nodes would not fit in
/// this machine's memory.
/// @throw openvdb::ValueError with the number of nodes and what they take
/// Cost: O(nodes that are no leaves).
void requireRoomForNodes(const openvdb::BoolGrid& object);

} // namespace openvdb_spheretree::detail
