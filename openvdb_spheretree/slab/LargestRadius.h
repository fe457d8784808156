// SPDX-License-Identifier: Apache-2.0
/// @file LargestRadius.h
/// @brief How many bits the numbers of a level need, known before they are computed.

#pragma once

#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>

namespace openvdb_spheretree {
namespace slab {

/// @return a number that no squared distance of the level exceeds. The lengths of runs bound it, and
///         the distances among leaves. Only where both bounds are beyond what narrow labels hold, it
///         is the largest distance itself, by a distance transform of which nothing is kept.
/// @param threads  at most, each with memory for the distances of a slab
/// @throw openvdb::ValueError if a radius is 46340 voxels or more
uint32_t largestDistSq(const LeafLayout& layout, int dim, uint32_t threads,
    openvdb::util::NullInterrupter* interrupter);

/// @throw openvdb::ValueError if power labels do not hold a ball of that size
void requireRadius(uint32_t distSq);

} // namespace slab
} // namespace openvdb_spheretree
