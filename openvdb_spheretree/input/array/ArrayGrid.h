// SPDX-License-Identifier: Apache-2.0
/// @file ArrayGrid.h
/// @brief An array of a file to a sparse grid, without ever holding the whole array.
///
/// Eight slices along the array's slowest axis make one layer of leaves. The next eight are read while
/// the leaves of these are built; rows that are all zeros are tested as words, so empty space costs one
/// read. Cost: one pass over the numbers, and the leaves that hold one. Memory: the result, and sixteen
/// slices.

#pragma once

#include "ArrayLayout.h"
#include "ByteSource.h"

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree::detail {

constexpr const char* kNotNumbersMeta = "nan_values";

struct ArrayGridSettings {
    /// The value of voxels that are inactive, and of all beyond the array.
    double background = 0;
    /// Whether leaves of one value become tiles.
    bool tiles = true;
};

/// @return a BoolGrid of bools, an Int32Grid of integers up to int32, an Int64Grid of larger ones, a
///         FloatGrid, or a DoubleGrid of float64. Number (0, 0, 0) is at that voxel. Voxels that have
///         the background, or a NaN, are inactive; where there are any NaN, metadata `nan_values` says how many.
/// @throw openvdb::IoError without the name of a file: what @a source throws, or if the background is
///        no value of the grid
/// @throw Interrupted; std::bad_alloc
openvdb::GridBase::Ptr gridOf(ByteSource& source, const ArrayLayout& layout,
    const ArrayGridSettings& settings, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
