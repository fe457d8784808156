// SPDX-License-Identifier: Apache-2.0
/// @file PointGrids.h
/// @brief Grids of points as other programs make them. OpenVDB's templates for it take seconds to compile,
/// so they are here once.

#pragma once

#include <openvdb/points/PointDataGrid.h>
#include <openvdb/tools/PointIndexGrid.h>

#include <vector>

namespace spheretree_test {

/// A grid of points at the places, in world units, with no attribute but these.
openvdb::points::PointDataGrid::Ptr pointsAt(
    const std::vector<openvdb::Vec3d>& places, double voxelSize = 1);

/// The same, with places of 16 bits an axis.
openvdb::points::PointDataGrid::Ptr packedPointsAt(
    const std::vector<openvdb::Vec3d>& places, double voxelSize = 1);

/// The voxels that hold the points' numbers.
openvdb::tools::PointIndexGrid::Ptr pointIndicesOf(
    const std::vector<openvdb::Vec3d>& places, double voxelSize = 1);

} // namespace spheretree_test
