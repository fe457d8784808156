// SPDX-License-Identifier: Apache-2.0
/// @file ArrayVoxels.h
/// @brief A dense array of any layout to the voxels of its object, or to a sparse grid of its values. The
/// array is read where it lies.
///
/// Leaf by leaf, in parallel: a task has a row of leaves along the axis on which values lie closest, so each
/// line of cache is fetched once. Cost: one pass over the values, and the leaves that hold any.

#pragma once

#include <openvdb_spheretree/input/array/NumberType.h>
#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <array>
#include <cstdint>
#include <string>

namespace binding {

/// A view: whoever makes it keeps the values alive. Its first voxel has the index (0, 0, 0).
struct VoxelArray {
    const char* data = nullptr;
    openvdb_spheretree::NumberType type = openvdb_spheretree::NumberType::Bool;
    std::array<int64_t, 3> shape{};  ///< along x, y, z
    std::array<int64_t, 3> stride{}; ///< the same, in bytes; may be negative, or 0
};

/// @brief The voxels whose values are asked for: of a bool array those that are true, else what
/// ObjectSettings say of scalar grids, by the values of voxel centers.
/// @throw InputError if a value is a NaN, naming the first; openvdb_spheretree::Interrupted
openvdb::MaskTree::Ptr maskOf(const VoxelArray& array,
    const openvdb_spheretree::ObjectSettings& settings,
    openvdb::util::NullInterrupter* interrupter);

/// @brief All values that are not @a background as active voxels: a bool, 32-bit or 64-bit integer, float
/// or double grid. Values beyond 2^63 - 1 become that.
/// @throw as above
openvdb::GridBase::Ptr gridOf(
    const VoxelArray& array, double background, openvdb::util::NullInterrupter* interrupter);

} // namespace binding
