// SPDX-License-Identifier: Apache-2.0
#include "ObjectReference.h"

#include <openvdb/math/BBox.h>
#include <openvdb/math/Transform.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace spheretree_test {

using openvdb::Vec3d;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

openvdb::math::BBox<Vec3d> boxOf(const std::vector<WorldBall>& balls)
{
    openvdb::math::BBox<Vec3d> box;
    for (const WorldBall& ball : balls) {
        box.expand(ball.center - Vec3d(ball.radius));
        box.expand(ball.center + Vec3d(ball.radius));
    }
    return box;
}

} // namespace

std::vector<WorldCube> cubes(const QuerySample& sample)
{
    std::vector<WorldCube> all;
    const Vec3d half(0.5);
    const double scale = sample.settings.scale;
    for (const Coord& voxel : sample.voxels) {
        const Vec3d a = scale * sample.tree.transform->indexToWorld(voxel.asVec3d() - half);
        const Vec3d b = scale * sample.tree.transform->indexToWorld(voxel.asVec3d() + half);
        all.push_back({openvdb::math::minComponent(a, b), openvdb::math::maxComponent(a, b)});
    }
    return all;
}

double distanceToBalls(const Vec3d& point, const std::vector<WorldBall>& balls)
{
    double least = kInfinity;
    for (const WorldBall& ball : balls)
        least = std::min(least, (point - ball.center).length() - ball.radius);
    return least;
}

double distanceToCubes(const Vec3d& point, const std::vector<WorldCube>& cubes)
{
    double least = kInfinity;
    for (const WorldCube& cube : cubes) {
        const Vec3d nearest =
            openvdb::math::maxComponent(cube.low, openvdb::math::minComponent(cube.high, point));
        least = std::min(least, (point - nearest).length());
    }
    return least;
}

double entryOfBalls(const PlainRay& ray, const std::vector<WorldBall>& balls, double grown)
{
    double first = kInfinity;
    const double a = ray.direction.lengthSqr();
    for (const WorldBall& ball : balls) {
        // By the distance of the center to the line: no cancellation.
        const Vec3d to = ball.center - ray.origin;
        const double middle = to.dot(ray.direction) / a, radius = ball.radius + grown;
        const double halfSq = (radius * radius - (to - middle * ray.direction).lengthSqr()) / a;
        if (halfSq < 0) continue;
        const double in = std::max(middle - std::sqrt(halfSq), ray.near);
        const double out = std::min(middle + std::sqrt(halfSq), ray.far);
        if (in <= out) first = std::min(first, in);
    }
    return first;
}

double entryOfCubes(const PlainRay& ray, const std::vector<WorldCube>& cubes)
{
    double first = kInfinity;
    for (const WorldCube& cube : cubes) {
        double in = ray.near, out = ray.far;
        for (int axis = 0; axis < 3; ++axis) {
            const double d = ray.direction[axis];
            const double low = cube.low[axis] - ray.origin[axis],
                         high = cube.high[axis] - ray.origin[axis];
            if (d == 0) {
                if (low > 0 || high < 0) in = kInfinity;
                continue;
            }
            in = std::max(in, std::min(low / d, high / d));
            out = std::min(out, std::max(low / d, high / d));
        }
        if (in <= out) first = std::min(first, in);
    }
    return first;
}

Vec3d randomPoint(Random& random, const std::vector<WorldBall>& balls)
{
    if (random.chance(0.5)) {
        const WorldBall& ball = balls[std::size_t(random.between(0, int(balls.size()) - 1))];
        return ball.center + ball.radius * uniform(random, 0, 1.5) * randomDirection(random);
    }
    const auto box = boxOf(balls);
    Vec3d point;
    for (int axis = 0; axis < 3; ++axis) {
        const double side = box.max()[axis] - box.min()[axis];
        point[axis] = box.min()[axis] + side * uniform(random, -0.25, 1.25);
    }
    return point;
}

double sizeOf(const std::vector<WorldBall>& balls)
{
    const auto box = boxOf(balls);
    return (box.max() - box.min()).length() / 2;
}

SphereTree turnedTree(SphereTree tree, const Vec3d& offset)
{
    const auto turned = [](const auto& v) { return std::decay_t<decltype(v)>(v[1], v[2], v[0]); };
    for (Vec3d& center : tree.spheres.center) center = turned(center);
    for (Coord& voxel : tree.ijk) voxel = turned(voxel);
    const Vec3d origin = turned(tree.transform->indexToWorld(Vec3d(0.0)));
    tree.transform = openvdb::math::Transform::createLinearTransform(tree.voxelSize());
    tree.transform->postTranslate(origin + offset);
    return tree;
}

} // namespace spheretree_test
