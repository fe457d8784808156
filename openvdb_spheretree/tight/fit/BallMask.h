// SPDX-License-Identifier: Apache-2.0
/// @file BallMask.h
/// @brief Which voxels of an 8x8x8 leaf a ball holds, exactly.

#pragma once

#include "FineBall.h"
#include <openvdb_spheretree/voxel/LeafLayout.h>

namespace openvdb_spheretree {
namespace tight {

/// @return the voxels of the leaf at @a origin that lie in @a ball.
LeafMask ballMask(const FineBall& ball, const openvdb::Coord& origin);

/// How far the nearest and the farthest voxel of a box are from a ball's centre.
struct BoxReach {
    int64_t nearestSq = 0, farthestSq = 0; ///< 1/16 voxel, squared; the nearest along each axis

    BoxReach(const FineBall& ball, const openvdb::CoordBBox& box);
    bool meets(const FineBall& ball) const { return nearestSq <= ball.radiusSq; }
    /// @return whether the ball holds all of the box.
    bool isHeldBy(const FineBall& ball) const { return farthestSq <= ball.radiusSq; }
};

/// @return whether @a ball comes as near to the leaf as one of its voxels.
bool mayReach(const FineBall& ball, const openvdb::Coord& origin);

/// @return the smallest box of voxels that holds all voxels of @a ball; false if it has none.
bool ballBox(const FineBall& ball, openvdb::CoordBBox& box);

} // namespace tight
} // namespace openvdb_spheretree
