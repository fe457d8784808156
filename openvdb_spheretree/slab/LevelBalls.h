// SPDX-License-Identifier: Apache-2.0
/// @file LevelBalls.h
/// @brief The medial balls of a level, as a stream of labels (LabelStream.h) returns them.

#pragma once

#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/voxel/LeafMask.h>
#include <openvdb_spheretree/voxel/MedialBall.h>

#include <vector>

namespace openvdb_spheretree {
namespace slab {

struct LevelBalls {
    std::vector<MedialBall> balls; ///< ordered by center
    std::vector<LeafMask> centers; ///< of the balls, a mask for each leaf
    StageSeconds seconds;          ///< of distances, power labels and balls
};

} // namespace slab
} // namespace openvdb_spheretree
