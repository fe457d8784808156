// SPDX-License-Identifier: Apache-2.0
/// @file MedialBall.h
/// @brief A ball of voxels, as the medial axis and the sphere-trees are made of.

#pragma once

#include <openvdb/Types.h>

#include <cstdint>

namespace openvdb_spheretree {

/// The digital ball { q : |q - center|^2 < radiusSq }, in voxels of its level; of a norm,
/// { q : N(q - center)^2 < radiusSq }, in its units.
struct MedialBall {
    openvdb::Coord center;
    int32_t radiusSq;

    bool operator==(const MedialBall& o) const
    {
        return center == o.center && radiusSq == o.radiusSq;
    }
};

} // namespace openvdb_spheretree
