// SPDX-License-Identifier: Apache-2.0
/// @file StoredSphere.h
/// @brief The radius that a nearest sphere is stored with: a float, rounded to nearest, with which it holds the same
/// voxels.
///
/// Centers are multiples of 1/16 voxel, so squared distances to voxel centers are 32 (1/16 voxel)^2 apart or more:
/// |16q - c|^2 = |c|^2 + 256|q|^2 - 32 q.c. Of all radii with the same voxels, the one in the middle between two such
/// values is taken: no voxel center is near its sphere. A float is off by 2^-25 of it at most, which moves no voxel
/// up to radii of 700 voxels. The sphere is then what the float says (`coverRadiusSq` and `radius` are made from it), so
/// what is counted of it holds for the stored sphere, whatever its radius. Tests: TestNearestTree.cc.

#pragma once

#include <openvdb_spheretree/sphere/ExactSphere.h>

namespace openvdb_spheretree::nearest {

struct StoredSphere {
    ExactSphere sphere;    ///< 1/16 voxel: that of radiusWorld
    float radiusWorld = 0; ///< world units
    double radius = 0;     ///< the same in voxels
};

/// @param voxelSize  world units
/// @throw openvdb::ValueError if no float is that large, or that small
StoredSphere storedSphere(const ExactSphere& sphere, double voxelSize);

} // namespace openvdb_spheretree::nearest
