// SPDX-License-Identifier: Apache-2.0
/// @file GeneratedObject.h
/// @brief Objects of any size, made by rule: for benchmarks, and for trying things out.
///
/// The rules are integer arithmetic, so an object is the same on every machine, and for any number
/// of threads. All but the ball begin at the origin, with coordinates of 0 and more.
///
/// | shape   | what it is                                   | a leaf's voxels | in             |
/// |---------|----------------------------------------------|-----------------|----------------|
/// | gyroid  | a curved wall of 6 voxels, everywhere alike  | 170             | GyroidShape.h  |
/// | menger  | a sponge with holes of every size            | 160             | MengerShape.h  |
/// | terrain | a hilly sheet, 3 voxels thick or more        | 120             | TerrainShape.h |
/// | noise   | single voxels, 1% of a cube                  | 5               | NoiseShape.h   |
/// | ball    | a solid ball around the origin, mostly tiles |                 | BallShape.h    |
///
/// Gyroid, menger and noise fill a box whose sides differ by one at most, terrain a square; the
/// sides are those that come nearest to the number of voxels.

#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <string>

namespace openvdb_spheretree {

enum class Shape { Gyroid, Menger, Terrain, Noise, Ball };

struct GeneratedObjectSettings {
    static constexpr int64_t kFewestVoxels = 1000; ///< of fewer, sizes would be too far apart
    static constexpr double kSmallestVoxel = 2e-5; ///< OpenVDB's own limit is at 1.4e-5
    static constexpr double kLargestVoxel = 1e30;

    Shape shape = Shape::Gyroid;
    int64_t voxels = 1000000; ///< on in the object, within 10%; kFewestVoxels or more
    uint64_t seed = 1;        ///< of terrain and noise; the other shapes have no choice
    double voxelSize = 1;     ///< in world units

    /// @throw openvdb::ValueError, before any work, if the object cannot be made: too few voxels,
    ///        more than 2^31 leaf nodes or than this machine has memory for, or a voxel size that
    ///        is none
    void validate() const;
};

/// @return the object, named after its shape. Leaf nodes hold a voxel at least; nodes that are
/// inside a ball are tiles.
///
/// Cost: linear in leaf nodes, in parallel. Noise takes two seconds of processor time for 10^7
/// voxels, the others less than one for 10^8. Memory: the grid, and little else.
/// @throw openvdb::ValueError as validate() does
/// @throw Interrupted if the interrupter (may be null) said so
openvdb::BoolGrid::Ptr generateObject(
    const GeneratedObjectSettings& settings, openvdb::util::NullInterrupter* interrupter = nullptr);

/// `gyroid`, `menger`, `terrain`, `noise`, `ball`.
const char* toString(Shape);
/// @throw openvdb::ValueError that lists the names, if @a text is none
Shape shapeFromString(const std::string& text);

} // namespace openvdb_spheretree
