// SPDX-License-Identifier: Apache-2.0
/// @file TestBallScene.cc
/// @brief What a ray hits first of many balls, and what blocks it, by the kernel of rays: against a loop over all balls, made
/// a little larger and a little smaller.

#include "support/RandomObjects.h"

#include <openvdb_spheretree/picture/BallScene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace openvdb_spheretree::detail;
using openvdb::Vec3d;
using spheretree_test::Random;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// More than balls grow by where none is farther than 300 from the origin: 32 x 2^-24 x 300, and rounding.
constexpr double kSlack = 6e-4;

Vec3d randomPoint(Random& random, int reach)
{
    constexpr int kUnit = 1 << 10;
    return random.coord(-reach * kUnit, reach * kUnit).asVec3d() / kUnit;
}

std::vector<BallShape> randomBalls(Random& random, int count, double largest)
{
    std::vector<BallShape> balls;
    while (int(balls.size()) < count) {
        const double radius = 0.5 + (largest - 0.5) * random.between(0, 1024) / 1024.0;
        balls.push_back({randomPoint(random, 100), radius});
    }
    return balls;
}

/// The textbook formula, of balls larger by @a grown. Those that hold the start do not count.
double entryOfBalls(const std::vector<BallShape>& balls, const Ray& ray, double grown)
{
    double nearest = kInfinity;
    for (const BallShape& ball : balls) {
        const Vec3d o = ray.origin - ball.center;
        const double radius = ball.radius + grown, b = 2 * o.dot(ray.direction);
        const double c = o.dot(o) - radius * radius, d = b * b - 4 * c;
        const double t = (-b - std::sqrt(d)) / 2;
        if (d >= 0 && t >= 0 && t < nearest) nearest = t;
    }
    return nearest;
}

bool startsNearASurface(const std::vector<BallShape>& balls, const Ray& ray)
{
    for (const BallShape& ball : balls) {
        const double off = (ray.origin - ball.center).length() - ball.radius;
        if (std::abs(off) < 2 * kSlack) return true;
    }
    return false;
}

/// @return whether something was hit.
bool expectNearest(const std::vector<BallShape>& balls, const Ray& ray, const BallScene& scene)
{
    const double soonest = entryOfBalls(balls, ray, kSlack) - kSlack;
    const double latest = entryOfBalls(balls, ray, -kSlack) + kSlack;
    const auto hit = scene.nearest(ray);
    const double t = hit ? hit->distance : kInfinity;
    EXPECT_GE(t, soonest);
    EXPECT_LE(t, latest);
    EXPECT_FALSE(scene.isBlocked(ray, 0.99 * soonest));
    EXPECT_TRUE(latest == kInfinity || scene.isBlocked(ray, latest + kSlack));
    if (!hit) return false;
    const BallShape& ball = balls[std::size_t(hit->shape)];
    EXPECT_NEAR((ray.at(t) - ball.center).length(), ball.radius, kSlack);
    EXPECT_EQ(hit->normal, (ray.at(t) - ball.center).unit());
    return true;
}

} // namespace

TEST(BallScene, TheNearestBallIsThatOfALoopOverAll)
{
    int hits = 0, misses = 0;
    for (uint32_t seed = 1; seed <= 12; ++seed) {
        Random random(seed);
        const auto balls = randomBalls(random, 1 << seed, seed % 3 == 0 ? 40 : 3);
        const BallScene scene(balls);
        for (int i = 0; i < 1000; ++i) {
            const Vec3d from = randomPoint(random, 130), to = randomPoint(random, 130);
            if (from == to) continue;
            const Ray ray(from, (to - from).unit());
            if (startsNearASurface(balls, ray)) continue;
            (expectNearest(balls, ray, scene) ? hits : misses) += 1;
        }
    }
    EXPECT_GT(hits, 2000);
    EXPECT_GT(misses, 2000);
}

/// As rays to the light do: the ball that they leave does not shade itself.
TEST(BallScene, ARayLeavesTheBallThatItStartsOn)
{
    Random random(3);
    for (const double clear : {0.0, 1e-4, 1e-3}) {
        const std::vector<BallShape> balls = {
            {Vec3d(0.0), 20}, {Vec3d(0, 0, 90), 8}, {Vec3d(100, 100, 100), 1}};
        const BallScene scene(balls);
        for (int i = 0; i < 500; ++i) {
            const Vec3d normal = randomPoint(random, 1);
            const Vec3d across = normal.cross(randomPoint(random, 1));
            if (across.length() < 0.1) continue;
            const Vec3d start = (20 + clear) * normal.unit();
            const Vec3d along = (0.001 * normal.unit() + across.unit()).unit();
            const auto hit = scene.nearest(Ray(start, along));
            EXPECT_TRUE(!hit || hit->shape != 0) << clear << start << along;
        }
        EXPECT_EQ(scene.nearest(Ray(Vec3d(0, 0, 20 + clear), Vec3d(0, 0, 1)))->shape, 1);
        EXPECT_TRUE(scene.isBlocked(Ray(Vec3d(0, 0, 20 + clear), Vec3d(0, 0, 1))));
        EXPECT_FALSE(scene.isBlocked(Ray(Vec3d(0, 0, 20 + clear), Vec3d(0, 0, 1)), 61));
    }
}

TEST(BallScene, ABallThatHoldsTheEyeIsLookedOutOf)
{
    const std::vector<BallShape> balls = {{Vec3d(0.0), 5}, {Vec3d(0, 0, -20), 1}};
    const auto hit = BallScene(balls).nearest(Ray(Vec3d(0.0), Vec3d(0, 0, -1)));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->shape, 1);
    EXPECT_NEAR(hit->distance, 19, 1e-12);
}

/// A ray that grazes a ball within the slack touches it where it is nearest to its center.
TEST(BallScene, WhereARayGrazesABallIsBesideItsCenter)
{
    const std::vector<BallShape> balls = {{Vec3d(0.0), 5}, {Vec3d(200, 0, 0), 1}};
    const auto hit = BallScene(balls).nearest(Ray(Vec3d(-50, 5 + 1e-5, 0), Vec3d(1, 0, 0)));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->shape, 0);
    EXPECT_NEAR(hit->distance, 50, 1e-9);
    EXPECT_NEAR(hit->normal[1], 1, 1e-12);
    EXPECT_FALSE(BallScene(balls).nearest(Ray(Vec3d(-50, 5.01, 0), Vec3d(1, 0, 0))));
}

TEST(BallScene, FloatsAreFineEnoughNearTheOriginAlone)
{
    EXPECT_TRUE(BallScene::isFineEnough({{Vec3d(0.0), 5}, {Vec3d(8000, 0, 0), 1}}));
    EXPECT_FALSE(BallScene::isFineEnough({{Vec3d(0.0), 5}, {Vec3d(8192, 0, 0), 1}}));
    EXPECT_FALSE(BallScene::isFineEnough({{Vec3d(0.0), 8192}}));
}
