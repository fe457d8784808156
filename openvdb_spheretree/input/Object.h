// SPDX-License-Identifier: Apache-2.0
/// @file Object.h
/// @brief Any OpenVDB grid to the object it stands for: the active voxels of a BoolGrid.

#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {

struct ObjectSettings {
    double iso = 0;       ///< level sets: the object is where the value is < iso (world units)
    double threshold = 0; ///< other scalar grids: the object is where the value is > threshold
    bool values = false;  ///< bool grids: count voxels of value true rather than active ones
};

/// @brief The object that @a grid stands for, with the grid's name and transform.
/// Level set -> its interior, voxels far inside included; mask, bool and point grids -> topology
/// (a voxel holding at least one point); any other scalar grid -> active and inactive values above
/// the threshold. Tiles stay tiles.
/// Of a grid that OpenVDB reads with delayed loading, values are read one leaf a thread at a time,
/// and stay in the file: a grid of more values than memory becomes a mask all the same.
/// @throw openvdb::TypeError if the grid is of a kind that bounds no object (vector, string grids)
/// @throw openvdb::ValueError if the object is empty or unbounded, or voxels are not uniform; the
///        message names the grid
/// @throw openvdb::IoError, openvdb::RuntimeError if values are left in a file that is damaged or
///        has changed
openvdb::BoolGrid::Ptr objectOf(const openvdb::GridBase& grid, const ObjectSettings& settings = {},
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return whether objectOf() accepts grids of this type.
bool isObjectGrid(const openvdb::GridBase& grid);

} // namespace openvdb_spheretree
