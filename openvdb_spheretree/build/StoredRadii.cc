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
#include <utility>

namespace openvdb_spheretree::detail {

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

} // namespace

void storeRadii(SphereTree& tree, openvdb::util::NullInterrupter* interrupter)
{
    const double padding = tree.settings.paddingVoxels();
    const double voxel = largestStretch(*tree.transform);
    for (Spheres* spheres : {&tree.spheres, &tree.cuts.spheres}) {
        std::vector<float> stored;
        resizeLarge(stored, spheres->radius.size());
        parallelFor(stored.size(), interrupter, [&](std::size_t i) {
            const double padded = addUp(spheres->radius[i], padding);
            stored[i] = storedRadius(multiplyUp(padded, voxel));
        });
        spheres->radiusWorld = std::move(stored);
    }
}

/// Stored leaf spheres were rounded up, and centers in the world are rounded. So a node's stored
/// sphere is made larger than its radius by about two units in a float's last place, which is
/// enough for any leaf. (To search for the leaf that decides took longer than all else that is done
/// to radii.)
void containStoredLeaves(
    SphereTree& tree, const std::vector<double>& radii, openvdb::util::NullInterrupter* interrupter)
{
    // A world coordinate is a sum of terms, each with a relative error of some 2^-52, in whatever
    // order a reader adds them up; they may be large and cancel out. Distances inherit the error.
    constexpr double kUnit = 1e-15;
    constexpr double kRounding = 1e-12; // more than that of all terms here
    constexpr double kLeastFloat = 0x1p-149;
    const double voxel = largestStretch(*tree.transform);
    const double padding = tree.settings.paddingVoxels();
    const auto world = [&](double radius) { return (radius + padding) * voxel; };

    struct Most {
        double excess = 0; // of a leaf's stored radius over what it stands for
        double away = 0;   // of a leaf's center from voxel 0
    };
    const auto larger = [](const Most& a, const Most& b) -> Most {
        return {std::max(a.excess, b.excess), std::max(a.away, b.away)};
    };
    const SphereTreeLevel& leaves = tree.levels.front();
    const Most most = tbb::parallel_reduce(
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
    const double doubt = 16 * kUnit * (voxel * most.away + moved); // of distances in the world

    parallelFor(std::size_t(leaves.begin), interrupter, [&](std::size_t id) {
        // A float is rounded up by no more than 2^-23 of it, a leaf ball's is not the larger one.
        const double exact = world(radii[id]);
        const double excess = std::min(most.excess, exact * 0x1p-23 + kLeastFloat);
        const float stored = storedRadius((exact + excess + doubt) * (1 + kRounding));
        tree.spheres.radiusWorld[id] = std::max(tree.spheres.radiusWorld[id], stored);
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

} // namespace openvdb_spheretree::detail
