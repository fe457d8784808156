// SPDX-License-Identifier: Apache-2.0
/// @file BallReach.h
/// @brief Which voxels, leaves and boxes of voxels a ball of a tight tree can reach.

#pragma once

#include "FineSphere.h"

#include <openvdb/Types.h>

namespace openvdb_spheretree::tight {

/// How far the nearest and the farthest point of a box of voxels are from a ball's center.
struct BoxReach {
    int64_t nearestSq = 0, farthestSq = 0; ///< 1/16 voxel, squared

    BoxReach(const ExactSphere& ball, const openvdb::CoordBBox& box);
    bool meets(const ExactSphere& ball) const { return nearestSq <= ball.radiusSq; }
    /// @return whether the ball holds all of the box.
    bool isHeldBy(const ExactSphere& ball) const { return farthestSq <= ball.radiusSq; }
};

/// @return whether @a ball reaches the box of the leaf at @a origin, and so may hold a voxel of it.
bool mayReach(const ExactSphere& ball, const openvdb::Coord& origin);

/// @return the smallest box of voxels that holds all voxels of @a ball; CoordBBox() if it has none.
openvdb::CoordBBox ballBox(const ExactSphere& ball);

} // namespace openvdb_spheretree::tight
