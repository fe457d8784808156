// SPDX-License-Identifier: Apache-2.0
/// @file Object.h
/// @brief Any OpenVDB grid to the object it stands for: the active voxels of a BoolGrid.

#pragma once

#include "ValueBound.h"

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace openvdb_spheretree {

/// Which voxels belong to the object of a grid of numbers, by where they are in the solid. The solid
/// is where the trilinear interpolation of the grid's values (of all: active or not, of tiles and of
/// the background) is below the iso, or above the threshold.
enum class Coverage {
    Centers, ///< those whose center is in the solid
    Cubes,   ///< those whose closed cube meets it: the object covers the solid, thin parts too
    Whole    ///< those whose closed cube lies wholly in it: the solid covers the object
};

struct ObjectSettings {
    double iso = 0;       ///< level sets: the object is where the value is < iso (world units)
    double threshold = 0; ///< other scalar grids: the object is where the value is > threshold
    bool values = false;  ///< bool grids: count voxels of value true rather than active ones
    Coverage coverage = Coverage::Centers; ///< level sets and other scalar grids, but for labels

    /// @name Other scalar grids, in place of the threshold
    /// @{
    std::optional<ValueBound> above; ///< the object is where the value is > this,
    std::optional<ValueBound> below; ///< and < this; one of them is enough
    std::vector<int64_t> labels;     ///< the object is where the value is one of these
    /// @}
};

/// @brief The object that @a grid stands for, with the grid's name and transform.
/// Level set -> its interior, voxels far inside included; mask, bool and point grids -> topology
/// (a voxel holding at least one point); any other scalar grid -> active and inactive values above
/// the threshold, or in the range, or of the labels that are asked for. Tiles stay tiles. A NaN is
/// outside, and so is the interpolation wherever one takes part in it.
/// Of a grid that OpenVDB reads with delayed loading, values are read one leaf a thread at a time
/// (1024 where cubes are looked at), and stay in the file: a grid of more values than memory becomes a
/// mask all the same.
/// Comparisons are exact, those of interpolated values too.
/// @param notNumbers  may be null; receives how many of the grid's values are NaN, a tile being one of them
/// @throw openvdb::TypeError if the grid is of a kind that bounds no object (vector, string grids)
/// @throw openvdb::ValueError (EmptyObject) if the object is empty
/// @throw openvdb::ValueError if it is unbounded, or voxels are not uniform, or
///        settings contradict each other or the grid; the message names the grid
/// @throw openvdb::IoError, openvdb::RuntimeError if values are left in a file that is damaged or
///        has changed
openvdb::BoolGrid::Ptr objectOf(const openvdb::GridBase& grid, const ObjectSettings& settings = {},
    openvdb::util::NullInterrupter* interrupter = nullptr, int64_t* notNumbers = nullptr);

/// Text metadata of objects of interpolated values and of meshes: `centers`, `cubes` or `whole`. objectOf()
/// and meshToObject() set it, and it goes on from object to object.
constexpr const char* kCoverageKey = "spheretree_coverage";
void setCoverage(openvdb::BoolGrid& object, Coverage coverage);

/// @return by what rule the voxels of a grid were taken from a solid; nothing if it does not say.
std::optional<Coverage> coverageOf(const openvdb::GridBase& grid);

/// @return whether objectOf() accepts grids of this type.
bool isObjectGrid(const openvdb::GridBase& grid);

} // namespace openvdb_spheretree
