// SPDX-License-Identifier: Apache-2.0
/// @file QueryData.h
/// @brief What a QueryTree is: blocks of spheres about an origin, and what they promise.

#pragma once

#include "QueryTree.h"
#include "SphereBlocks.h"

#include <openvdb/math/Transform.h>

#include <cstdint>
#include <limits>

namespace openvdb_spheretree::detail {

struct QueryData {
    SphereBlocks spheres;
    openvdb::Vec3d origin{0, 0, 0}; ///< of the blocks' coordinates, in the world
    int32_t firstLeafId = 0;        ///< node id of leaf 0; those of others follow
    uint64_t identity = 0;          ///< of the leaves: LeafIdentity.h
    bool holdsObject = false;       ///< the chains of QueryTree.h
    bool holdsLeaves = false;
    double leafReach = std::numeric_limits<double>::infinity(); ///< world units
    double leafInset = std::numeric_limits<double>::infinity(); ///< world units

    openvdb::Vec3d world(const FloatSphere& s) const
    {
        return origin + openvdb::Vec3d(s.x, s.y, s.z);
    }
};

} // namespace openvdb_spheretree::detail
