// SPDX-License-Identifier: Apache-2.0
/// @file SphereFile.h
/// @brief Readers of spheres that other tools have made: tables (`.csv`), JSON and point grids.
///
/// A table has a header that names the columns x, y, z and one of radius, r, diameter, d, in any
/// order and among any others; or no header, and four columns x y z radius. Columns are separated
/// by commas, semicolons, tabs or blanks. Empty lines are skipped, and those that begin with '#'.
///
/// JSON is an array of objects, or an object with such an array as a member. An entry is {"x", "y",
/// "z", "radius"} or {"center": [x, y, z], "radius"}; r, diameter and d will do for the radius.
/// Trees that this library wrote are read as well.
///
/// Spheres may have a level each: a column or member `level`. Then those of one level are taken.

#pragma once

#include "WorldSpheres.h"
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <optional>
#include <string>

namespace openvdb_spheretree {

/// @return whether the name ends with `.csv` or `.json`, in any case.
bool isSphereFileName(const std::string& path);

/// @return whether this build reads `.json`, because it has nlohmann-json.
bool readsSphereJson();

/// @param level    of files in which spheres have one: which are taken; by default the finest there is
/// @param shownAs  in place of @a path, what messages and the spheres are named after, and whose extension
///                 says the format: for files without a name of their own
/// @throw openvdb::IoError if the file cannot be read, is damaged, or holds no sphere; the message
///        names the file, and the line or entry. (A table cut between two lines is read as the
///        shorter table that it is.)
/// Memory: 40 bytes a sphere while reading, and a line.
WorldSpheres readSphereFile(
    const std::string& path, std::optional<int> level = {}, const std::string& shownAs = {});

/// @brief The points of a grid as spheres, whoever wrote it: each at its position `P`, with the radius
/// of the attribute `pscale` or, if there is none, `radius`.
/// @throw openvdb::ValueError naming the grid, if it is no point grid, has neither attribute, or
///        contradicts itself, or if a radius is not above 0 and finite
WorldSpheres spheresOfPoints(const openvdb::GridBase& grid);

} // namespace openvdb_spheretree
