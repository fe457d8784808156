// SPDX-License-Identifier: Apache-2.0
/// @file detail/WorldDistance.h
/// @brief How far the centres of a tree's nodes are apart in the world, by the distance its balls
/// are balls of.
///
/// Euclidean: between the centres in world space, as a reader of the file has them. Norms have the
/// axes of index space, whatever way the transform turns it; their lengths are scaled.

#pragma once

#include "../SphereTree.h"
#include "../UniformVoxels.h"

#include <vector>

namespace openvdb_spheretree {
namespace detail {

class WorldDistance {
public:
    explicit WorldDistance(const SphereTree& tree) : mDistance(tree.settings.dist)
    {
        if (!mDistance.isEuclidean()) {
            mCenter = tree.center;
            mScale = largestStretch(*tree.transform) / mDistance.unit();
            return;
        }
        mCenter.reserve(tree.center.size());
        for (int32_t id = 0; id < tree.size(); ++id) mCenter.push_back(tree.centerWorld(id));
    }
    double operator()(int32_t a, int32_t b) const
    {
        const openvdb::Vec3d d = mCenter[a] - mCenter[b];
        return mDistance.length(d[0], d[1], d[2]) * mScale;
    }

private:
    Distance mDistance;
    double mScale = 1;
    std::vector<openvdb::Vec3d> mCenter;
};

} // namespace detail
} // namespace openvdb_spheretree
