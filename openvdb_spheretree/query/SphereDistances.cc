// SPDX-License-Identifier: Apache-2.0
#include "SphereDistances.h"

#include "PointFrame.h"
#include "PointKernel.h"
#include "QueryData.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Rounding.h>

#include <openvdb/Exceptions.h>
#include <openvdb/util/NodeMasks.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {
namespace {

using detail::BlockHit;
using detail::FloatSphere;
using detail::LocalPoint;
using openvdb::Vec3d;
using openvdb::Vec3f;

constexpr std::size_t kTogether =
    detail::kMostFiltered; ///< spheres that go to a kernel in one call

/// @return sphere @a i of flat arrays.
FloatSphere sphereAt(const float* spheres, std::size_t i)
{
    const FloatSphere s{spheres[4 * i], spheres[4 * i + 1], spheres[4 * i + 2], spheres[4 * i + 3]};
    if (std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.r))
        return s;
    OPENVDB_THROW(openvdb::ValueError,
        "sphere " << i << " (" << s.x << ", " << s.y << ", " << s.z << ", radius " << s.r
                  << ") has numbers that are not finite");
}

Vec3d centerOf(const FloatSphere& s) { return Vec3d(s.x, s.y, s.z); }

/// The root's sphere as far as the activation distance around it. Larger by more than what its center and this sum are
/// rounded by: 8 parts in 2^24 of each.
detail::BallAround aroundTree(const detail::QueryData& tree, double activation)
{
    const Vec3d center = tree.world(tree.spheres.root);
    const double reach = tree.spheres.root.r + activation;
    const double rounding = 8 * detail::kFloatError * (center.length() + reach);
    const Vec3f rounded(center);
    return {rounded[0], rounded[1], rounded[2], detail::toFloatUp(reach + rounding)};
}

/// Calls visit(i, sphere) for those of a few spheres that may be around the tree.
template <typename Visit>
void forEachAround(const detail::BallAround& around, const float* spheres, std::size_t begin,
    std::size_t end, const Visit& visit)
{
    uint32_t left = detail::spheresWithin(around, spheres + 4 * begin, end - begin);
    for (; left != 0; left &= left - 1) {
        const std::size_t i = begin + openvdb::util::FindLowestOn(left);
        const FloatSphere sphere = sphereAt(spheres, i);
        if (sphere.r >= 0) visit(i, sphere);
    }
}

/// Spheres whose distances are asked for in one call of a kernel.
class Group {
public:
    Group(const detail::QueryData& tree, const detail::BallAround& around, float activation,
        const SphereDistanceArrays& results)
        : mTree(tree), mAround(around), mActivation(activation), mResults(results)
    {}

    void run(const float* spheres, std::size_t begin, std::size_t end)
    {
        clear(begin, end);
        mSize = 0;
        forEachAround(mAround, spheres, begin, end, [&](std::size_t i, const FloatSphere& s) {
            const LocalPoint local(mTree, centerOf(s));
            mQuestions[mSize] = {local.x, local.y, local.z, local.limit(double(mActivation) + s.r)};
            mSphere[mSize++] = i;
        });
        BlockHit hits[kTogether];
        detail::nearestLeaves(mTree.spheres, mQuestions, mSize, hits);
        for (std::size_t k = 0; k < mSize; ++k) {
            if (hits[k].leaf >= 0) store(mSphere[k], sphereAt(spheres, mSphere[k]), hits[k].leaf);
        }
    }

private:
    void clear(std::size_t begin, std::size_t end) const
    {
        const std::size_t count = end - begin;
        if (mResults.distance) std::fill_n(mResults.distance + begin, count, mActivation);
        if (mResults.gradient) std::fill_n(mResults.gradient + 3 * begin, 3 * count, 0.0f);
        if (mResults.leaf) std::fill_n(mResults.leaf + begin, count, -1);
    }

    void store(std::size_t i, const FloatSphere& s, int32_t leaf) const
    {
        const detail::LeafDistance found(mTree, LocalPoint(mTree, centerOf(s)), leaf);
        const double distance = found.distance - s.r;
        if (distance > mActivation) return;
        if (mResults.distance) mResults.distance[i] = detail::toFloatDown(distance);
        if (mResults.leaf) mResults.leaf[i] = leaf;
        if (!mResults.gradient) return;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            mResults.gradient[3 * i + axis] = float(found.gradient[int(axis)]);
        }
    }

    const detail::QueryData& mTree;
    const detail::BallAround& mAround;
    float mActivation;
    const SphereDistanceArrays& mResults;
    std::size_t mSize = 0;
    detail::PointQuestion mQuestions[kTogether];
    std::size_t mSphere[kTogether];
};

/// @return whether any sphere from @a begin to @a end, kTogether at most, meets a leaf.
bool anyTouches(const detail::QueryData& tree, const detail::BallAround& around,
    const float* spheres, std::size_t begin, std::size_t end)
{
    FloatSphere balls[kTogether];
    std::size_t size = 0;
    forEachAround(around, spheres, begin, end, [&](std::size_t, const FloatSphere& s) {
        const LocalPoint local(tree, centerOf(s));
        balls[size++] = {local.x, local.y, local.z, local.limit(s.r)};
    });
    int64_t blocks = 0;
    return size > 0 && detail::firstBallThatMeets(tree.spheres, balls, size, blocks) < size;
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
    const detail::BallAround around = aroundTree(tree.data(), activation);
    const std::size_t groups = (count + kTogether - 1) / kTogether;
    detail::parallelFor(groups, interrupter, [&](std::size_t g) {
        Group group(tree.data(), around, activation, results);
        group.run(spheres, g * kTogether, std::min(count, (g + 1) * kTogether));
    });
}

void spheresTouch(const QueryTree& tree, const float* spheres, std::size_t configurations,
    std::size_t perConfiguration, uint8_t* touching, openvdb::util::NullInterrupter* interrupter)
{
    const detail::BallAround around = aroundTree(tree.data(), 0);
    detail::parallelFor(configurations, interrupter, [&](std::size_t c) {
        const std::size_t first = c * perConfiguration, end = first + perConfiguration;
        touching[c] = 0;
        for (std::size_t i = first; i < end && !touching[c]; i += kTogether) {
            touching[c] = anyTouches(tree.data(), around, spheres, i, std::min(end, i + kTogether));
        }
    });
}

} // namespace openvdb_spheretree
