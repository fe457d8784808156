// SPDX-License-Identifier: Apache-2.0
/// @file LeafBalls.h
/// @brief The balls that level 0 of a tight tree is made of: medial balls, or spheres that were
/// given.

#pragma once

#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/sphere/ExactSphere.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree::tight {

struct LeafBalls {
    std::vector<ExactSphere> balls;
    std::vector<MedialBall> digital; ///< the same as digital balls; empty if they are none
};

/// @param level  of the object
/// @return its medial balls: all, or those that are needed (BallPruning.h).
LeafBalls medialLeaves(const MedialLevel& level, const SampleLevel& object, Leaves which,
    openvdb::util::NullInterrupter* interrupter);

/// @brief Given spheres that hold a voxel of the object, in their order. Centers are rounded to
/// 1/16 of a voxel, and radii grow by as much as that moves them, so that a ball contains its given
/// sphere.
/// @param given  a tree of them in the frame of the object (GivenTree.h)
/// @param flat   how @a object was turned
/// @throw openvdb::ValueError if voxels of the object are in no ball, with their number and one of
///        them; or if a radius exceeds 32767 voxels
LeafBalls givenLeaves(const SphereTree& given, const FlatAxis& flat,
    const openvdb::MaskTree& voxels, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::tight
