// SPDX-License-Identifier: Apache-2.0
#include "SphereDistances.h"

#include "PointFrame.h"
#include "PointKernel.h"
#include "QueryData.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Rounding.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {
namespace {

using detail::BlockHit;
using detail::FloatSphere;
using detail::LocalPoint;
using openvdb::Vec3d;

constexpr std::size_t kTogether = 32; ///< spheres that go to a kernel in one call

/// @return sphere @a i of flat arrays.
FloatSphere sphereAt(const float* spheres, std::size_t i)
{
    const FloatSphere s{spheres[4 * i], spheres[4 * i + 1], spheres[4 * i + 2], spheres[4 * i + 3]};
    if (std::isfinite(s.x + s.y + s.z + s.r)) return s;
    const bool overflows =
        std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.r);
    if (overflows) return s;
    OPENVDB_THROW(openvdb::ValueError,
        "sphere " << i << " (" << s.x << ", " << s.y << ", " << s.z << ", radius " << s.r
                  << ") has numbers that are not finite");
}

/// Spheres that are within the activation distance of the root's sphere, and so have a question to the kernel.
class Group {
public:
    Group(const detail::QueryData& tree, float activation, const SphereDistanceArrays& results)
        : mTree(tree), mActivation(activation), mResults(results),
          mCenter(tree.world(tree.spheres.root))
    {}

    void run(const float* spheres, std::size_t begin, std::size_t end)
    {
        mSize = 0;
        for (std::size_t i = begin; i < end; ++i) add(i, sphereAt(spheres, i));
        BlockHit hits[kTogether];
        detail::nearestLeaves(mTree.spheres, mQuestions, mSize, hits);
        for (std::size_t k = 0; k < mSize; ++k) {
            if (hits[k].leaf >= 0) store(spheres, mSphere[k], hits[k].leaf);
        }
    }

private:
    void add(std::size_t i, const FloatSphere& s)
    {
        if (mResults.distance) mResults.distance[i] = mActivation;
        if (mResults.gradient) std::fill_n(mResults.gradient + 3 * i, 3, 0.0f);
        if (mResults.leaf) mResults.leaf[i] = -1;
        const Vec3d center(s.x, s.y, s.z);
        const double cutoff = double(mActivation) + s.r, reach = mTree.spheres.root.r + cutoff;
        if (s.r < 0 || (center - mCenter).lengthSqr() > reach * reach * (1 + 1e-6)) return;
        const LocalPoint local(mTree, center);
        mQuestions[mSize] = {local.x, local.y, local.z, local.limit(cutoff)};
        mSphere[mSize++] = i;
    }

    void store(const float* spheres, std::size_t i, int32_t leaf)
    {
        const Vec3d center(spheres[4 * i], spheres[4 * i + 1], spheres[4 * i + 2]);
        const detail::LeafDistance found(mTree, LocalPoint(mTree, center), leaf);
        const double distance = found.distance - spheres[4 * i + 3];
        if (distance > mActivation) return;
        if (mResults.distance) mResults.distance[i] = detail::toFloatDown(distance);
        if (mResults.leaf) mResults.leaf[i] = leaf;
        if (!mResults.gradient) return;
        for (int axis = 0; axis < 3; ++axis)
            mResults.gradient[3 * i + axis] = float(found.gradient[axis]);
    }

    const detail::QueryData& mTree;
    float mActivation;
    const SphereDistanceArrays& mResults;
    Vec3d mCenter;
    std::size_t mSize = 0;
    detail::PointQuestion mQuestions[kTogether];
    std::size_t mSphere[kTogether];
};

/// @return whether a sphere of a configuration meets a leaf.
bool touches(
    const detail::QueryData& tree, const float* spheres, std::size_t begin, std::size_t end)
{
    const Vec3d middle = tree.world(tree.spheres.root);
    FloatSphere balls[kTogether];
    std::size_t size = 0;
    int64_t blocks = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const FloatSphere s = sphereAt(spheres, i);
        const Vec3d center(s.x, s.y, s.z);
        const double reach = (double(tree.spheres.root.r) + s.r) * (1 + 1e-6);
        if (s.r < 0 || (center - middle).lengthSqr() > reach * reach) continue;
        const LocalPoint local(tree, center);
        balls[size++] = {local.x, local.y, local.z, local.limit(s.r)};
        if (size < kTogether) continue;
        if (detail::firstBallThatMeets(tree.spheres, balls, size, blocks) < size) return true;
        size = 0;
    }
    return detail::firstBallThatMeets(tree.spheres, balls, size, blocks) < size;
}

} // namespace

void sphereDistances(const QueryTree& tree, const float* spheres, std::size_t count,
    float activation, const SphereDistanceArrays& results,
    openvdb::util::NullInterrupter* interrupter)
{
    if (!(activation >= 0)) {
        OPENVDB_THROW(openvdb::ValueError,
            "activation=" << activation << " is no distance: it must be 0 or more");
    }
    const std::size_t groups = (count + kTogether - 1) / kTogether;
    detail::parallelFor(groups, interrupter, [&](std::size_t g) {
        Group group(tree.data(), activation, results);
        group.run(spheres, g * kTogether, std::min(count, (g + 1) * kTogether));
    });
}

void spheresTouch(const QueryTree& tree, const float* spheres, std::size_t configurations,
    std::size_t perConfiguration, uint8_t* touching, openvdb::util::NullInterrupter* interrupter)
{
    detail::parallelFor(configurations, interrupter, [&](std::size_t c) {
        const std::size_t begin = c * perConfiguration;
        touching[c] = touches(tree.data(), spheres, begin, begin + perConfiguration);
    });
}

} // namespace openvdb_spheretree
