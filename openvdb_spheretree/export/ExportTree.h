// SPDX-License-Identifier: Apache-2.0
/// @file ExportTree.h
/// @brief Spheres of a tree as a file that another tool reads: robots, film, discrete elements, viewers.
///
///     ExportSettings settings;
///     settings.scale = 1000; // millimetres of metres
///     for (const std::string& note : exportTree(tree, *findExportFormat(".urdf"), settings, out)) say(note);
///
/// Where a file holds fewer digits than the tree, centers are rounded to what it holds, and radii give way
/// by as much: spheres that cover the object still do as they are read, and those inside it stay inside.

#pragma once

#include "ExportFormat.h"
#include <openvdb_spheretree/measure/MassProperties.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace openvdb_spheretree {

/// Where the origin of a file is, and along what its axes are. The two others are those of the body that the
/// finest level in the file is: the union of its spheres, with the same density everywhere. Samples over time are all
/// in the frame of the first.
enum class ExportFrame {
    World,    ///< as the tree is
    Centroid, ///< the center of mass; axes as in the world
    Principal ///< the center of mass and the principal axes, that of the least moment of inertia first
};

enum class UpAxis { Y, Z };

struct ExportSettings {
    /// The level to write. Without it, and without `spheres`: all levels in a format that holds them,
    /// else the finest.
    std::optional<int> level;
    /// The finest level with at most so many spheres, or the cut with so many.
    std::optional<int64_t> spheres;
    ExportFrame frame = ExportFrame::World;
    double scale = 1;         ///< units of the file in a world unit
    double metersPerUnit = 1; ///< how many metres a unit of the file is, for formats that say so
    UpAxis up = UpAxis::Y;    ///< which axis of the file is up, for formats that say so
    double density = 1;       ///< mass of a cubed unit of the file, for formats with a mass
    /// Of the body whose mass, center and inertia such formats get, in world space; by default the union of the
    /// spheres of the finest level in the file.
    std::optional<MassProperties> mass;
    /// The link of a robot that each tree's spheres belong to; empty: what linksOf() gives.
    std::vector<std::string> links;
    std::string name; ///< of the robot, model or prim; by default that of the tree
    /// How many units of sample times a second has, for formats with samples.
    double framesPerSecond = 24;
    /// The times of several trees, rising; empty: 1, 2, 3 and so on.
    std::vector<double> sampleTimes;
};

/// @return whether it is not called as all trees are by default.
bool hasOwnName(const SphereTree& tree);

/// @return the name for a file that is given none: that of the tree; and of a robot's file its own, without folder and
/// extension, where the tree has no name of its own, or where there are several.
/// @param trees  at least one
/// @param path   empty: a stream without a name
std::string exportNameFor(const std::vector<const SphereTree*>& trees, const ExportFormat& format,
    const std::string& path);

/// @return the links of trees for which none are given: their names. A tree alone is "object" where it has no name of its
/// own, and in formats of one link.
std::vector<std::string> linksOf(
    const std::vector<const SphereTree*>& trees, const ExportFormat& format);

/// @brief Write one tree. One without levels, that of no object, is a file without spheres where the format has room
/// for none.
/// @return what the format has no room for, a sentence each; empty if all of the tree is in the file
/// @throw openvdb::ValueError if the format cannot hold what is asked for, with the reason; openvdb::IoError if
/// the stream fails
std::vector<std::string> exportTree(const SphereTree& tree, const ExportFormat& format,
    const ExportSettings& settings, std::ostream& out,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief Write trees that are the samples of one thing over time, in formats that hold time; or the links of one robot,
/// each in its own frame, in formats that hold several.
/// @param trees  at least one; of samples each with the levels that are asked for by number
std::vector<std::string> exportTrees(const std::vector<const SphereTree*>& trees,
    const ExportFormat& format, const ExportSettings& settings, std::ostream& out,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
