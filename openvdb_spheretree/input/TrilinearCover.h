// SPDX-License-Identifier: Apache-2.0
/// @file TrilinearCover.h
/// @brief Voxels whose closed cube meets a solid, or lies wholly in it, where the solid is what the
/// trilinear interpolation of a grid's values says, below or above a bound.
///
/// Values count active or not, and so do those of tiles and of the background. Between the centers of
/// eight voxels the interpolation is affine in each coordinate, so over a box its extremes are at
/// corners. A voxel's cube is cut by the planes through its center into eight boxes, whose corners
/// are 27 points: the center, and offsets of +-1/2 along one, two or three axes. There the
/// interpolation is the mean of 1, 2, 4 or 8 values. Comparisons are exact (MeanOrder.h). A mean of
/// values of which one is a NaN is outside.
///
/// A mean is beyond a bound only if one of its values is, so a cube can meet the solid only where
/// its own center or one of the 26 around it is in the solid.
///
/// 1. Places of leaf nodes that a voxel may be added to, or taken from, are made leaf nodes: beside
///    voxels and tiles of the mask, or in its tiles, where they end (TilePlaces). All other tiles stay.
/// 2. Leaf by leaf, in parallel, the values of a leaf and the voxels around it are gathered
///    (SampleBlock). Most voxels have all 27 values on one side; of others the 27 means are tried.
///
/// Cost: linear in the leaf nodes of the mask; some 0.2 us for a voxel at the surface. Leaf nodes
/// whose values are still in the file are read where needed and let go, up to 1024 a thread.
/// Tests: TestTrilinearCover.cc.

#pragma once

#include "MeanOrder.h"
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree::detail {

/// @brief Adds the voxels whose cube meets the solid.
/// @param centers  the voxels whose center is in the solid, none of them within 8192 of an end of
///                 32-bit coordinates; inactive nodes are pruned
/// @param solid    no complement
/// @throw Interrupted if the interrupter (may be null) said so
template <typename TreeT>
void addMetCubes(const TreeT& values, const HalfSpace& solid, openvdb::MaskTree& centers,
    openvdb::util::NullInterrupter* interrupter);

/// @brief Takes the voxels away whose cube is not wholly in the solid.
/// @param centers  voxels whose center is in the solid
/// @param solid    may be a complement
/// @throw as addMetCubes()
template <typename TreeT>
void keepWholeCubes(const TreeT& values, const HalfSpace& solid, openvdb::MaskTree& centers,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
