// SPDX-License-Identifier: Apache-2.0
/// @file MemoryPlan.h
/// @brief How a build is going to keep to its memory, before it starts.

#pragma once

#include <openvdb_spheretree/tree/SphereTreeSettings.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <string>

namespace openvdb_spheretree {

/// For the power labels of the level that has the most, and for the levels of a tight tree. That level is 0; for
/// a tight tree of named counts it is the level of the pyramid that the tree is likely to be made on.
struct MemoryPlan {
    int64_t allowed = 0;      ///< bytes, by SphereTreeSettings::memory
    int64_t needed = 0;       ///< bytes, at most
    int64_t slabs = 0;        ///< of that level: each is one leaf node thick, along x
    int64_t slabsAtATime = 0; ///< whose distances and labels are computed together
    bool packed = false;      ///< whether labels are compressed; else all are kept in memory
    int64_t packedBytes = 0;  ///< of all labels before they are compressed, if they are
    int64_t storedBytes = 0;  ///< of compressed labels that may stay in memory; others go to a file
    /// @name Of a tight tree's levels, within a factor of three. Of small parts far apart they may be many times too large,
    /// but no more leaf balls are guessed than there are voxels. 0 for other trees, and over given spheres.
    /// @{
    int64_t leafBalls = 0;
    double levelsBytes = 0;   ///< at its peak; labels are gone then
    double levelsSeconds = 0; ///< of one processor
    /// @}
};

/// @brief Ask before a long build, or find out why one is refused.
/// @param settings     `memory`, and which labels it is about
/// @param interrupter  may be null
/// @throw openvdb::ValueError if buildSphereTree() would, for lack of memory for labels, or for the regions of named counts
///        of a tight tree; or for a radius that does not fit
/// @throw Interrupted if the interrupter said so
/// @note Cost: O(leaf nodes log leaf nodes); where balls may have radii above 127 voxels, that of a
///       distance transform; for tight trees that of a pyramid, and of the leaf balls of coarse levels.
MemoryPlan memoryPlan(const openvdb::BoolGrid& object, const SphereTreeSettings& settings = {},
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return a line about it, for people.
std::string toString(const MemoryPlan& plan);

} // namespace openvdb_spheretree
