// SPDX-License-Identifier: Apache-2.0
/// @file LargestRadius.h
/// @brief How many bits the numbers of a level need, known before they are computed.

#pragma once

#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>

namespace openvdb_spheretree::slab {

/// @return a number that no squared distance of the level exceeds: a bound by the lengths of runs,
///         or one by the distances among leaves. If narrow labels hold neither, it is the largest
///         squared distance itself, by a distance transform of which nothing is kept.
/// @param threads  at most, each with memory for the distances of a slab
/// @throw openvdb::ValueError if a radius is 46340 voxels or more
uint32_t largestDistSq(const LeafLayout& layout, int dim, uint32_t threads,
    openvdb::util::NullInterrupter* interrupter);

/// @param distSq  the largest squared distance of a transform in 32 bits
/// @throw openvdb::ValueError if they do not hold it
void requireWide(uint32_t distSq);

/// @throw openvdb::ValueError if power labels do not hold a ball of that size
void requireRadius(uint32_t distSq);

} // namespace openvdb_spheretree::slab
