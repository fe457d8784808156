// SPDX-License-Identifier: Apache-2.0
#include "StoredRadii.h"

#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Rounding.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/math/Transform.h>
#include <openvdb/Exceptions.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {
namespace detail {

namespace {

/// @return a radius in world units, rounded up to a float.
float storedRadius(double radius)
{
    const float stored = toFloatUp(radius);
    if (std::isfinite(stored)) return stored;
    OPENVDB_THROW(openvdb::ValueError,
        "a radius of " << radius
                       << " world units does not fit a float: use another unit of length, or less "
                          "padding");
}

/// @return radii in world units: padding added, voxels to world units, rounded up to floats.
std::vector<float> storedRadii(const SphereTree& tree, const std::vector<double>& radii,
    openvdb::util::NullInterrupter* interrupter)
{
    const double padding = tree.settings.paddingVoxels();
    const double voxel = largestStretch(*tree.transform);
    std::vector<float> stored;
    resizeLarge(stored, radii.size());
    parallelFor(radii.size(), interrupter, [&](std::size_t i) {
        const double padded = addUp(radii[i], padding);
        stored[i] = storedRadius(multiplyUp(padded, voxel));
    });
    return stored;
}

/// How much larger than its radius a node's stored sphere is made, to contain the stored leaf
/// spheres below it, which were rounded up too, and centres in the world are rounded: about two
/// units in a float's last place. To search for the leaf that decides took longer than all else
/// that is done to radii.
class StoredSlack {
public:
    StoredSlack(const SphereTree& tree, openvdb::util::NullInterrupter* interrupter)
        : mVoxel(largestStretch(*tree.transform)), mPadding(tree.settings.paddingVoxels())
    {
        const SphereTreeLevel& leaves = tree.levels.front();
        Most most = tbb::parallel_reduce(
            tbb::blocked_range<int32_t>(leaves.begin, leaves.end), Most(),
            [&](const tbb::blocked_range<int32_t>& range, Most result) {
                for (int32_t id = range.begin(); id < range.end(); ++id) {
                    const openvdb::Vec3d& c = tree.spheres.center[id];
                    const double away = std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]);
                    const double excess =
                        double(tree.spheres.radiusWorld[id]) - world(tree.spheres.radius[id]);
                    result = larger(result, {excess, away});
                }
                return result;
            },
            larger);
        checkInterrupt(interrupter);
        const double moved = tree.transform->indexToWorld(openvdb::Vec3d(0)).length();
        mExcess = most.excess;
        mDoubt = 16 * kUnit * (mVoxel * most.away + moved);
    }

    /// @param radius  that contains the leaf balls below, in voxels
    /// @return a radius for the stored sphere.
    float radius(double radius) const
    {
        // A float is rounded up by no more than 2^-23 of it, a leaf ball's is not the larger one.
        const double exact = world(radius);
        const double excess = std::min(mExcess, exact * 0x1p-23 + kLeastFloat);
        return storedRadius((exact + excess + mDoubt) * (1 + kRounding));
    }

private:
    struct Most {
        double excess = 0, away = 0;
    };
    static Most larger(const Most& a, const Most& b)
    {
        return {std::max(a.excess, b.excess), std::max(a.away, b.away)};
    }
    double world(double radius) const { return (radius + mPadding) * mVoxel; }

    // A world coordinate is a sum of terms, each with a relative error of some 2^-52, in whatever
    // order a reader adds them up; they may be large and cancel out. Distances inherit the error.
    static constexpr double kUnit = 1e-15;
    static constexpr double kRounding = 1e-12; // more than that of all terms here
    static constexpr double kLeastFloat = 0x1p-149;

    const double mVoxel, mPadding;
    double mExcess = 0; ///< of a leaf's stored radius over what it stands for
    double mDoubt = 0;  ///< of distances in the world, of any two centres
};

} // namespace

void storeRadii(SphereTree& tree, openvdb::util::NullInterrupter* interrupter)
{
    tree.spheres.radiusWorld = storedRadii(tree, tree.spheres.radius, interrupter);
    tree.cuts.spheres.radiusWorld = storedRadii(tree, tree.cuts.spheres.radius, interrupter);
}

void containStoredLeaves(
    SphereTree& tree, const std::vector<double>& radii, openvdb::util::NullInterrupter* interrupter)
{
    const StoredSlack slack(tree, interrupter);
    const int32_t leaves = tree.levels.front().begin;
    parallelFor(std::size_t(leaves), interrupter, [&](std::size_t id) {
        tree.spheres.radiusWorld[id] =
            std::max(tree.spheres.radiusWorld[id], slack.radius(radii[id]));
    });
}

std::vector<double> radiiAroundCut(const SphereTree& tree)
{
    const Distance& distance = tree.settings.dist();
    std::vector<double> radii = tree.spheres.radius;
    const SphereTreeLevel& cut = tree.levels.front();
    for (int32_t id = cut.begin; id < cut.end; ++id) {
        for (int32_t t = tree.spheres.parent[id]; t >= 0; t = tree.spheres.parent[t]) {
            const openvdb::Vec3d d = tree.spheres.center[t] - tree.spheres.center[id];
            const double apart = distance.length(d[0], d[1], d[2]) / distance.unit();
            radii[t] = std::max(radii[t], apart + tree.spheres.radius[id]);
        }
    }
    return radii;
}

} // namespace detail
} // namespace openvdb_spheretree
