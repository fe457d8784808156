// SPDX-License-Identifier: Apache-2.0
/// @file DigitalLeaves.h
/// @brief Whether a point lies in the object itself: exactly, by integers.
///
///     const DigitalLeaves leaves(tree);
///     if (contains(queries, leaves, point)) ...
///
/// The digital balls of level 0 are the object: a voxel belongs to it just if |q - center|^2 <
/// radiusSq for one of them. A point is rounded to its voxel q, once, in doubles; what follows is
/// exact. The leaf spheres around q are found by the blocks of the tree. None that matters is
/// missed: a chain of spheres holds the center of each voxel of the object, and spheres are taken
/// as larger by more than floats round.
///
/// This is kept apart from the tree, since no other question needs it: 16 bytes a leaf. Tests:
/// TestDigitalLeaves.cc.

#pragma once

#include "QueryTree.h"
#include <openvdb_spheretree/voxel/MedialBall.h>

#include <openvdb/math/Vec3.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

class DigitalLeaves {
public:
    /// @param settings  those that the tree of queries is made with
    /// @throw openvdb::ValueError where the leaves are not the object: a tree without level 0, or
    ///        without medial balls there (spheres=, error=, distance=), of side=inner, of given
    ///        spheres, of a norm, or without its voxel count.
    explicit DigitalLeaves(const SphereTree& tree, const QueryTreeSettings& settings = {});

    /// The digital ball of each leaf, by its number; voxels are those of the source grid.
    const std::vector<MedialBall>& balls() const { return mBalls; }
    /// @return the voxel that a point of the world lies in: between two, the one with the larger
    ///        coordinates.
    /// @throw openvdb::ValueError for coordinates that are not finite
    openvdb::Coord voxelOf(const openvdb::Vec3d& point) const;
    /// That of the QueryTree with these leaves.
    uint64_t identity() const { return mIdentity; }
    openvdb::Vec3d center(const openvdb::Coord& voxel) const;
    /// @return whether a voxel lies in the plane of an object with dim = 2; else true.
    bool isInPlane(const openvdb::Coord& voxel) const;

    std::size_t bytes() const { return sizeof(*this) + mBalls.capacity() * sizeof(MedialBall); }

private:
    std::vector<MedialBall> mBalls;
    openvdb::SharedPtr<const openvdb::math::Transform> mTransform;
    double mScale;
    uint64_t mIdentity;
    int mFlatAxis = -1; ///< with dim = 2
};

/// @return whether a point of the world lies in a voxel cube of the object. Exact, as above.
/// @param tree    made of the same sphere-tree, with the same settings
/// @throw openvdb::ValueError for a point that is not finite, and leaves of another tree
/// @note Cost: O(log leaves), 0.1 microseconds. Thread-safe.
bool contains(const QueryTree& tree, const DigitalLeaves& leaves, const openvdb::Vec3d& point);

} // namespace openvdb_spheretree
