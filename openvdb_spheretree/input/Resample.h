// SPDX-License-Identifier: Apache-2.0
/// @file Resample.h
/// @brief Grids whose voxels are no cubes, or too small or too large, as grids of cubes; and grids of
/// other units.

#pragma once

#include <openvdb/Grid.h>
#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {

/// @return the length of the shortest edge of a voxel, in world units: voxels of that size lose least.
/// @throw openvdb::ValueError if the grid's transform is not linear, or has no size
double shortestVoxelEdge(const openvdb::GridBase& grid);

/// What a value is made of, where a grid of numbers is resampled.
enum class Sampling {
    Linear, ///< the eight voxel centers around, by the trilinear interpolation
    Nearest ///< the voxel that holds the place: for labels, between which there is nothing
};

/// @brief The same grid with cubic voxels, along the axes of world space, of the same class, type and
/// name. The center of voxel (0, 0, 0) stays where it is.
///
/// A level set is made anew around its surface (OpenVDB's tools::levelSetRebuild), with a band of three
/// voxels to either side: its values are distances again. Grids of numbers are interpolated between the
/// eight voxel centers around (in doubles; integers are rounded to the nearest), bool and mask grids
/// take the voxel that holds the place. A voxel is active if any that it is made of is.
/// @param voxelSize  world units, > 0
/// @param sampling   of grids of numbers; bool and mask grids are always sampled by the nearest voxel
/// @throw openvdb::TypeError if the grid holds neither numbers nor a mask
/// @throw openvdb::ValueError if the size is none, or makes more voxels than this machine's memory
///        holds, or beyond 32-bit coordinates; or the transform is not linear; or the nearest voxel of
///        a level set is asked for, which would have steps
/// @throw openvdb::Exception if values are left in a file that is damaged
/// @throw Interrupted if the interrupter (may be null) said so
/// Cost: linear in voxels of the result; tiles are cut into voxels. Values of @a grid that OpenVDB has
/// left in the file are loaded.
openvdb::GridBase::Ptr resampled(const openvdb::GridBase& grid, double voxelSize,
    Sampling sampling = Sampling::Linear, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief Make the grid larger by a factor, in world space: from millimetres to metres by 0.001. The
/// distances that a level set holds are scaled as well, and loaded for that if they are in a file.
/// @param factor  > 0
/// @throw openvdb::ValueError if voxels would become too small or too large for doubles
void scaleGrid(openvdb::GridBase& grid, double factor);

} // namespace openvdb_spheretree
