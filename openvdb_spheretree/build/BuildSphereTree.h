// SPDX-License-Identifier: Apache-2.0
/// @file BuildSphereTree.h
/// @brief The call that builds a sphere-tree, of whatever kind.

#pragma once

#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/input/spheres/WorldSpheres.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {

/// @brief Build the sphere-tree of the active voxels of @a object.
/// @param object       its topology is the object; its transform must have uniform voxels
/// @param settings     what to build
/// @param seconds      may be null; receives the time each stage took
/// @param interrupter  may be null; asked from many threads
/// @throw openvdb::ValueError if the object is empty or too wide, its voxels are not uniform, a
///        setting is out of range, a radius does not fit (32767 voxels), or there is too little
///        memory (MemoryPlan.h)
/// @throw openvdb::IoError if a temporary file is needed, and cannot be made or has no room
/// @throw Interrupted if the interrupter said so
/// @note Cost is linear in active voxels per level (each level has about 1/factor^dim of the one
///       before), whatever the bounding box. The result is the same to the last bit for any number
///       of threads. Thread-safe for concurrent calls, also on the same object.
SphereTree buildSphereTree(const openvdb::BoolGrid& object, const SphereTreeSettings& settings = {},
    StageSeconds* seconds = nullptr, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief The same for the next frame of a sequence: its spheres have the tracks of those that they come from
/// (SphereTracks.h). Spheres of a tight tree of named counts start where they were, if that makes no level more than a
/// seventh worse, counted on samples (FollowedLevels.h).
/// @param last  the tree of the frame before
SphereTree buildNextSphereTree(const SphereTree& last, const openvdb::BoolGrid& object,
    const SphereTreeSettings& settings, StageSeconds* seconds = nullptr,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief The same for a tight tree whose level 0 is spheres that come from elsewhere (leaves=given). Those
/// that hold no voxel of the object are left out. Centers are rounded to 1/16 of a voxel, and radii grow
/// by as much as that moves them.
/// @param leaves  they must cover every voxel of @a object
/// @throw openvdb::ValueError as above; if they leave voxels bare, it says how many; or if the settings
///        are for no tight tree of leaves=given
SphereTree buildSphereTreeOver(const WorldSpheres& leaves, const openvdb::BoolGrid& object,
    const SphereTreeSettings& settings, StageSeconds* seconds = nullptr,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// What a tree may start from, beside its object; each may be null.
struct TreeStart {
    const WorldSpheres* leaves = nullptr; ///< of leaves=given: as of buildSphereTreeOver()
    const SphereTree* last = nullptr;     ///< as of buildNextSphereTree()
};

/// @brief The one of the above that fits. A tree of leaves=given is made without the frame before, and has its tracks.
SphereTree buildSphereTreeFrom(const TreeStart& start, const openvdb::BoolGrid& object,
    const SphereTreeSettings& settings, StageSeconds* seconds = nullptr,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
