// SPDX-License-Identifier: Apache-2.0
#include "BallScene.h"

#include <openvdb_spheretree/query/RayFrame.h>
#include <openvdb_spheretree/query/RayKernel.h>
#include <openvdb_spheretree/query/SphereForest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace openvdb_spheretree::detail {
namespace {

SphereForest forestOf(const std::vector<BallShape>& balls)
{
    SphereForest forest;
    forest.nodes.reserve(2 * balls.size());
    for (const BallShape& ball : balls) {
        const auto place = int32_t(forest.nodes.size());
        ForestNode node;
        node.center = ball.center;
        node.radius = ball.radius;
        node.leaf = place;
        forest.nodes.push_back(node);
        forest.roots.push_back(place);
    }
    divideWideNodes(forest);
    return forest;
}

/// As BallShape::entry(), of a ball that is entered but for rounding.
Hit hitOf(const BallShape& ball, int32_t shape, const Ray& ray)
{
    const openvdb::Vec3d toCenter = ball.center - ray.origin;
    const double nearest = toCenter.dot(ray.direction);
    const double halfSq =
        ball.radius * ball.radius - (toCenter - nearest * ray.direction).lengthSqr();
    const double t = std::max(0.0, nearest - std::sqrt(std::max(0.0, halfSq)));
    return {t, shape, ball.normal(ray, t)};
}

QueryRay rayThatLeaves(const Ray& ray)
{
    QueryRay result{ray.origin, ray.direction};
    result.leavesStart = true;
    return result;
}

} // namespace

bool BallScene::isFineEnough(const std::vector<BallShape>& balls)
{
    constexpr double kFarthest = 0x1p13; // times 32 kFloatError is 1/64
    return std::all_of(balls.begin(), balls.end(),
        [](const BallShape& ball) { return ball.center.length() + ball.radius < kFarthest; });
}

BallScene::BallScene(const std::vector<BallShape>& balls) : mBalls(balls)
{
    mTree.spheres = blocksOf(forestOf(balls), int32_t(balls.size()));
    mTree.origin = openvdb::Vec3d(0.0);
}

std::optional<Hit> BallScene::nearest(const Ray& ray) const
{
    const LocalRay local(mTree, rayThatLeaves(ray));
    if (local.misses) return {};
    const int32_t found = firstLeaf(mTree.spheres, local.question).leaf;
    if (found < 0) return {};
    return hitOf(mBalls[std::size_t(found)], found, ray);
}

bool BallScene::isBlocked(const Ray& ray, double far) const
{
    QueryRay bounded = rayThatLeaves(ray);
    bounded.tFar = far;
    LocalRay local(mTree, bounded);
    if (local.misses) return false;
    local.question.anyHit = true;
    return firstLeaf(mTree.spheres, local.question).leaf >= 0;
}

} // namespace openvdb_spheretree::detail
