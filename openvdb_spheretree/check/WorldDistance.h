// SPDX-License-Identifier: Apache-2.0
/// @file WorldDistance.h
/// @brief How far the centres of a tree's nodes are apart in the world, by the distance its balls
/// are balls of.
///
/// Euclidean: between the centres in world space, as a reader of the file has them. Norms have the
/// axes of index space, whatever way the transform turns it; their lengths are scaled.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

namespace openvdb_spheretree {
namespace detail {

class WorldDistance {
public:
    /// @param tree  kept by reference
    explicit WorldDistance(const SphereTree& tree) : mTree(tree), mDistance(tree.settings.dist())
    {
        if (!mDistance.isEuclidean()) mScale = largestStretch(*tree.transform) / mDistance.unit();
    }
    double operator()(int32_t a, int32_t b) const
    {
        const openvdb::Vec3d d = place(a) - place(b);
        return mDistance.length(d[0], d[1], d[2]) * mScale;
    }

private:
    openvdb::Vec3d place(int32_t id) const
    {
        return mDistance.isEuclidean() ? mTree.centerWorld(id) : mTree.spheres.center[id];
    }

    const SphereTree& mTree;
    const Distance mDistance;
    double mScale = 1;
};

} // namespace detail
} // namespace openvdb_spheretree
