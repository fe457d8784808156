// SPDX-License-Identifier: Apache-2.0
/// @file MemoryPlan.h
/// @brief How a build is going to keep to its memory, before it starts.

#pragma once

#include <openvdb_spheretree/tree/SphereTreeSettings.h>

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <string>

namespace openvdb_spheretree {

/// Of the power labels of level 0, which all other levels have fewer of.
struct MemoryPlan {
    int64_t allowed = 0;      ///< bytes, by SphereTreeSettings::memory
    int64_t needed = 0;       ///< bytes, at most
    int64_t slabs = 0;        ///< one leaf node thick, along x
    int64_t slabsAtATime = 0; ///< that distances and labels are computed of
    bool packed = false;      ///< labels are compressed; else they are in memory as they are
    int64_t packedBytes = 0;  ///< if so: all of them, before they are compressed
    int64_t storedBytes = 0;  ///< what of them, compressed, may stay in memory and out of a file
};

/// @brief Ask before a long build, or find out why one is refused.
/// @param settings     `memory`, and which labels it is about
/// @param interrupter  may be null
/// @throw openvdb::ValueError if buildSphereTree() would for want of memory, or for a radius that
///        does not fit
/// @throw Interrupted if the interrupter said so
/// @note Cost: O(leaf nodes log leaf nodes); where balls may have radii above 127 voxels, that of a
///       distance transform.
MemoryPlan memoryPlan(const openvdb::BoolGrid& object, const SphereTreeSettings& settings = {},
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return a line about it, for people.
std::string toString(const MemoryPlan& plan);

} // namespace openvdb_spheretree
