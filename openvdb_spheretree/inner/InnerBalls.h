// SPDX-License-Identifier: Apache-2.0
/// @file InnerBalls.h
/// @brief Spheres inside an object: for every number N, N of its medial balls that cover as much of
/// it as a greedy choice can. Robotics calls that a conservative approximation from within.
///
/// A ball is inside if its closed sphere, of radius sqrt(radiusSq - 1) around a voxel center, holds
/// the centers of object voxels only. At the surface, the sphere may reach out of their cubes by a
/// part of a voxel.

#pragma once

#include <openvdb_spheretree/voxel/MedialBall.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

/// @param object  its active voxels
/// @param most    how many balls at most; if there are fewer, their union is the object
/// @param dim     2 if the object is one voxel thick along some axis
/// @return balls in the order in which they are chosen: each adds the most voxels to those before
///         it. Centers are in the index space of @a object.
/// @throw openvdb::ValueError as medialBalls()
/// @throw Interrupted if @a interrupter (which may be null) said so
std::vector<MedialBall> innerBalls(const openvdb::BoolGrid& object, int64_t most, int dim = 3,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
