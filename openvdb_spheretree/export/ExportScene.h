// SPDX-License-Identifier: Apache-2.0
/// @file ExportScene.h
/// @brief What is written of a tree, in the frame and the units of the file, and rounded to its numbers.

#pragma once

#include "ExportFrame.h"
#include "ExportTree.h"
#include <openvdb_spheretree/measure/MassProperties.h>

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

/// One entry a sphere.
struct ExportLevel {
    int number = 0; ///< 0 is the finest of the tree
    std::vector<openvdb::Vec3d> centers;
    std::vector<double> radii;
    std::vector<int32_t> ids; ///< of the tree; its tracks, if it has any and the format takes them
    std::vector<int32_t> parents; ///< the same of the parents; -1 where one is not in the file

    std::size_t size() const { return centers.size(); }
    /// @return whether floats hold all ids: they count to 2^24.
    bool idsAreFloats() const;
};

struct ExportScene {
    std::string name, link;
    std::vector<ExportLevel> levels; ///< the coarsest first; at least one, but of an empty sample
    int decimals = 0; ///< of ExportNumbers::Decimal: all lengths are multiples of 10^-decimals
    double metersPerUnit = 1;
    UpAxis up = UpAxis::Y;
    double density = 1;          ///< mass of a cubed unit
    double sample = 1;           ///< its time
    double framesPerSecond = 24; ///< of sample times
    /// Of ExportSettings::mass, or of the union; zero in formats without a mass.
    MassProperties mass;

    const ExportLevel& finest() const { return levels.back(); }
    std::size_t sphereCount() const;
    /// @return xx yy zz xy xz yz of the inertia, the order in which most formats have them.
    std::array<double, 6> inertia() const;
    /// @return the smallest box that holds all of a level's spheres.
    static openvdb::BBoxd boxOf(const ExportLevel& level);
};

/// @param tree   without levels it is that of no object, and the scene has one level without spheres,
///               or none in a format with samples
/// @param place  of the tree among those of the file
/// @param frame  of a file of samples: that of the first of them, which is made with it, and serves all. If each had
///               its own, what moves would stand still.
/// @param notes  receives what of the tree is not in the scene
/// @throw openvdb::ValueError if the format cannot hold it
ExportScene makeScene(const SphereTree& tree, const ExportFormat& format,
    const ExportSettings& settings, std::size_t place, std::optional<FileFrame>& frame,
    std::vector<std::string>& notes, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
