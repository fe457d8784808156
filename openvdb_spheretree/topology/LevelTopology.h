// SPDX-License-Identifier: Apache-2.0
/// @file LevelTopology.h
/// @brief The Betti numbers of one level's voxels: how many parts, tunnels and cavities they have.
///
/// Each voxel is a closed unit cube, so voxels belong together when they share a corner (26-
/// connected) and background when it shares a face (6-connected): T. Y. Kong, A. Rosenfeld,
/// "Digital topology: introduction and survey", CVGIP 48, 1989. For objects one voxel thick, voxels
/// are thereby 8-connected in their plane, `tunnels` are the holes, and there are no cavities.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>

namespace openvdb_spheretree {

class LeafLayout;

/// The Betti numbers of a set of voxels as closed cubes: what a pyramid joins, and what it fills.
struct LevelTopology {
    int64_t components = 0; ///< connected by faces, edges or corners
    int64_t tunnels = 0;    ///< in two dimensions: holes
    int64_t cavities = 0;   ///< of the background, enclosed: connected by faces

    bool operator==(const LevelTopology& o) const
    {
        return components == o.components && tunnels == o.tunnels && cavities == o.cavities;
    }
};

/// @param level        may be empty: all three are 0
/// @param interrupter  may be null; asked from many threads
/// @throw Interrupted if the interrupter said so
/// @throw openvdb::ValueError if leaves are cut into more than 2^32 parts
/// @note Exact, and the same for any number of threads. Linear in leaves, wherever they are; some
///       24 bytes a leaf; where object or background is in parts, 512 more and 4 for each part.
LevelTopology levelTopology(
    const LeafLayout& level, openvdb::util::NullInterrupter* interrupter = nullptr);

/// The same of the active voxels of @a object. O(leaves log leaves), tiles counted as leaves.
LevelTopology levelTopology(
    const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
