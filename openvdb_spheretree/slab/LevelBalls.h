// SPDX-License-Identifier: Apache-2.0
/// @file LevelBalls.h
/// @brief What comes out of a stream of labels.

#pragma once

#include <openvdb_spheretree/voxel/MedialBall.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <vector>

namespace openvdb_spheretree {
namespace slab {

/// Seconds that stages took; those of one phase that run together share its time.
struct StreamSeconds {
    double distance = 0, power = 0, medial = 0;
};

struct LevelBalls {
    std::vector<MedialBall> balls; ///< ordered by centre
    std::vector<LeafMask> centers; ///< of balls, one mask a leaf
    StreamSeconds seconds;
};

} // namespace slab
} // namespace openvdb_spheretree
