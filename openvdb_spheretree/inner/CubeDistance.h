// SPDX-License-Identifier: Apache-2.0
/// @file CubeDistance.h
/// @brief How far a sphere around a voxel may reach without leaving the voxel cubes of an object.
///
/// That is the distance from the voxel's center to the nearest closed cube outside. The nearest point of it lies
/// on a corner, an edge or a face of a cube that shares a face with the object, at a multiple of half a voxel
/// along each axis: at a voxel of a grid of half the size. So the distance is one between voxels of that grid,
/// and its square is an integer there. (Of the cubes around a nearest point some are the object's, and among
/// these and those outside two share a face.)
///
/// Cost: O(surface) to build; a query is one of NearestVoxel.h. Exact. Tests: TestCubeDistance.cc.

#pragma once

#include <openvdb_spheretree/index/NearestVoxel.h>
#include <openvdb_spheretree/voxel/MaskTree.h>
#include <openvdb_spheretree/voxel/MedialBall.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace openvdb_spheretree::detail {

class CubeDistance {
public:
    /// @param object    not empty; needed only here
    /// @param flatAxis  the axis along which a flat object is one voxel thick and unbounded, or -1
    /// @throw Interrupted if the interrupter (may be null) said so
    CubeDistance(
        const openvdb::MaskTree& object, int flatAxis, openvdb::util::NullInterrupter* interrupter);

    /// @return the squared distance from the center of @a voxel, which is the object's, to the nearest cube outside,
    ///         in half voxels.
    int64_t halvesSq(const openvdb::Coord& voxel) const;

private:
    openvdb::Coord mOrigin; ///< keeps doubled coordinates in range
    std::unique_ptr<NearestVoxel> mOutside;
};

/// @return @a balls of the object, each with the largest integer radius (squared) for which its closed sphere
///         stays within the cubes.
std::vector<MedialBall> withinCubes(const std::vector<MedialBall>& balls,
    const CubeDistance& distance, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
