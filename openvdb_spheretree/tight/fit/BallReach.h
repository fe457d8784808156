// SPDX-License-Identifier: Apache-2.0
/// @file BallReach.h
/// @brief Which voxels, leaves and boxes of voxels a ball of a tight tree can reach.

#pragma once

#include "FineSphere.h"
#include <openvdb_spheretree/voxel/LeafMask.h>

#include <openvdb/Types.h>

#include <algorithm>

namespace openvdb_spheretree::tight {

/// How far the nearest and the farthest point of a box of voxels are from a ball's center.
struct BoxReach {
    int64_t nearestSq = 0, farthestSq = 0; ///< 1/16 voxel, squared

    BoxReach(const ExactSphere& ball, const openvdb::CoordBBox& box)
    {
        for (int a = 0; a < 3; ++a) {
            const int64_t first = kFine * int64_t(box.min()[a]);
            const int64_t last = kFine * int64_t(box.max()[a]);
            const int64_t c = ball.center[a];
            const int64_t near = std::max(first, std::min(c, last)) - c;
            const int64_t far = std::max(c - first, last - c);
            nearestSq += near * near;
            farthestSq += far * far;
        }
    }
    bool meets(const ExactSphere& ball) const { return nearestSq <= ball.radiusSq; }
    /// @return whether the ball holds all of the box.
    bool isHeldBy(const ExactSphere& ball) const { return farthestSq <= ball.radiusSq; }
};

/// @return the smallest box of voxels that holds all voxels of @a ball; CoordBBox() if it has none.
openvdb::CoordBBox ballBox(const ExactSphere& ball);

} // namespace openvdb_spheretree::tight
