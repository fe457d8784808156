// SPDX-License-Identifier: Apache-2.0
/// @file Contact.h
/// @brief Two leaf spheres of two bodies, and where they meet or are nearest.

#pragma once

#include <openvdb/Types.h>

#include <cstdint>
#include <limits>

namespace openvdb_spheretree {

/// Ids of two spheres in their sphere-trees (QueryTree::nodeId()).
struct NodePair {
    int32_t a = -1, b = -1; ///< -1: none

    bool isGiven() const { return a >= 0 && b >= 0; }
    bool operator==(const NodePair& o) const { return a == o.a && b == o.b; }
};

struct Contact {
    NodePair nodes;
    /// Of the centers less both radii, world units. Negative: how deep the two spheres meet, which is not how far the
    /// bodies must move to part.
    double distance = std::numeric_limits<double>::infinity();
    openvdb::Vec3d
        normal; ///< in the world, unit, from a's sphere to b's; along x of concentric ones
    /// The point of each sphere that is farthest along the line of centers towards the other's: in the world.
    openvdb::Vec3d pointA, pointB;

    /// @return the middle between both.
    openvdb::Vec3d point() const { return 0.5 * (pointA + pointB); }
};

} // namespace openvdb_spheretree
