// SPDX-License-Identifier: Apache-2.0
/// @file GeneratedObject.h
/// @brief Objects of any size that are made by a rule: for benchmarks and trials.
///
/// The rules are integer arithmetic, so an object is the same on every machine and for any number
/// of threads. All shapes but the ball have coordinates of 0 and more.
///
/// | shape   | what it is                                   | voxels per leaf | in             |
/// |---------|----------------------------------------------|-----------------|----------------|
/// | gyroid  | a curved wall of 6 voxels, everywhere alike  | 170             | GyroidShape.h  |
/// | menger  | a sponge with holes of every size            | 160             | MengerShape.h  |
/// | terrain | a hilly sheet, 3 voxels thick or more        | 120             | TerrainShape.h |
/// | noise   | single voxels, 1% of a cube                  | 5               | NoiseShape.h   |
/// | ball    | a solid ball around the origin, mostly tiles |                 | BallShape.h    |
///
/// Gyroid, menger and noise fill a box whose sides differ by one at most, and terrain a square. The
/// sides are those that come nearest to the number of voxels.

#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <string>
#include <vector>

namespace openvdb_spheretree {

enum class Shape { Gyroid, Menger, Terrain, Noise, Ball };

struct GeneratedObjectSettings {
    static constexpr int64_t kFewestVoxels = 1000; ///< fewer could not be met within 10%
    static constexpr double kSmallestVoxel = 2e-5; ///< OpenVDB's own limit is at 1.4e-5
    static constexpr double kLargestVoxel = 1e30;

    Shape shape = Shape::Gyroid;
    int64_t voxels = 1000000; ///< of the object, met within 10%; kFewestVoxels or more
    uint64_t seed = 1;        ///< of terrain and noise; the other shapes ignore it
    double voxelSize = 1;     ///< in world units

    /// @throw openvdb::ValueError if the object cannot be made: it has too few voxels, more than
    ///        2^31 leaf nodes, or more than fit into this machine's memory; or the voxel size is
    ///        out of range
    void validate() const;
};

/// @return the object, named after its shape. No leaf node is empty, and nodes inside a ball are
/// tiles.
///
/// Cost: linear in leaf nodes, in parallel. Noise takes two seconds of CPU time for 10^7 voxels,
/// the others less than one second for 10^8. Memory: little more than that of the grid.
/// @throw openvdb::ValueError as validate() does
/// @throw Interrupted if the interrupter (may be null) said so
openvdb::BoolGrid::Ptr generateObject(
    const GeneratedObjectSettings& settings, openvdb::util::NullInterrupter* interrupter = nullptr);

/// `gyroid`, `menger`, `terrain`, `noise`, `ball`.
const char* toString(Shape);
/// The same, in this order.
std::vector<std::string> shapeNames();
/// @throw openvdb::ValueError that lists the names, if @a text is none
Shape shapeFromString(const std::string& text);

} // namespace openvdb_spheretree
