// SPDX-License-Identifier: Apache-2.0
/// @file TestMiniball.cc
/// @brief The smallest ball around balls: shapes known by hand, and a search that shares nothing
/// with the library.

#include <openvdb_spheretree/paper/Miniball.h>

#include "support/RandomObjects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using openvdb::Vec3d;
using openvdb_spheretree::detail::miniball;
using openvdb_spheretree::detail::RealBall;
using spheretree_test::Random;

namespace {

using Balls = std::vector<RealBall>;

double farthestReach(const Vec3d& from, const Balls& balls)
{
    double most = 0;
    for (const RealBall& b : balls) most = std::max(most, (b.center - from).length() + b.radius);
    return most;
}

/// The least value of a convex function between two numbers.
template <typename F>
double leastBetween(double lo, double hi, const F& f)
{
    while (hi - lo > 1e-6) {
        const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
        (f(a) < f(b) ? hi : lo) = f(a) < f(b) ? b : a;
    }
    return f((lo + hi) / 2);
}

/// The farthest reach is convex in the centre: one search inside the other finds the least.
double searchedRadius(const Balls& balls)
{
    Vec3d lo = balls[0].center, hi = balls[0].center;
    for (const RealBall& ball : balls) {
        lo = openvdb::math::minComponent(lo, ball.center);
        hi = openvdb::math::maxComponent(hi, ball.center);
    }
    return leastBetween(lo[0], hi[0], [&](double x) {
        return leastBetween(lo[1], hi[1], [&](double y) {
            return leastBetween(lo[2], hi[2], [&](double z) {
                return farthestReach({x, y, z}, balls);
            });
        });
    });
}

/// It encloses the balls, and is no larger than need be.
void expectSmallest(const Balls& balls)
{
    const RealBall ball = miniball(balls);
    EXPECT_LE(farthestReach(ball.center, balls), ball.radius * (1 + 1e-12));
    EXPECT_NEAR(ball.radius, searchedRadius(balls), 2e-5);
}

void expectBall(const RealBall& ball, const Vec3d& center, double radius)
{
    EXPECT_NEAR(ball.radius, radius, 1e-9);
    EXPECT_NEAR((ball.center - center).length(), 0, 1e-9);
}

Balls randomBalls(Random& random, int count, int width, int largest)
{
    Balls balls;
    for (int i = 0; i < count; ++i) {
        const auto center = random.coord(-width, width);
        balls.push_back({center.asVec3d(), std::sqrt(double(random.between(0, largest)))});
    }
    return balls;
}

} // namespace

TEST(Miniball, OfOneBallIsThatBall)
{
    expectBall(miniball({{Vec3d(1, 2, 3), 4}}), {1, 2, 3}, 4);
    expectBall(miniball({{Vec3d(1, 2, 3), 0}}), {1, 2, 3}, 0);
    expectBall(miniball(Balls(7, {Vec3d(1, 2, 3), 0})), {1, 2, 3}, 0);
}

TEST(Miniball, OfShapesKnownByHand)
{
    expectBall(miniball({{Vec3d(0, 0, 0), 0}, {Vec3d(4, 0, 0), 0}}), {2, 0, 0}, 2);
    expectBall(miniball({{Vec3d(0, 0, 0), 1}, {Vec3d(4, 0, 0), 3}}), {3, 0, 0}, 4);
    expectBall(miniball({{Vec3d(0, 0, 0), 9}, {Vec3d(4, 0, 0), 3}}), {0, 0, 0}, 9);
    expectBall(miniball({{Vec3d(0, 0, 0), 5}, {Vec3d(2, 0, 0), 3}}), {0, 0, 0}, 5);
    const double third = std::sqrt(3.0) / 3;
    expectBall(
        miniball({{Vec3d(0, 0, 5), 1}, {Vec3d(2, 0, 5), 1}, {Vec3d(1, std::sqrt(3.0), 5), 1}}),
        {1, third, 5}, 1 + 2 * third);
    Balls cube;
    for (int corner = 0; corner < 8; ++corner) {
        cube.push_back({Vec3d(corner & 1, corner >> 1 & 1, corner >> 2) * 2.0, 0.5});
    }
    expectBall(miniball(cube), {1, 1, 1}, std::sqrt(3.0) + 0.5);
    cube.push_back({Vec3d(1, 1, 1), 2});
    expectBall(miniball(cube), {1, 1, 1}, std::sqrt(3.0) + 0.5);
    cube.push_back({Vec3d(1, 1, 1), 3});
    expectBall(miniball(cube), {1, 1, 1}, 3);
}

TEST(Miniball, StaysInThePlaneAndOnTheLineOfTheCentresExactly)
{
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        Balls balls = randomBalls(random, random.between(2, 30), 40, 60);
        for (RealBall& ball : balls) ball.center[2] = 0;
        ASSERT_EQ(miniball(balls).center[2], 0);
        for (RealBall& ball : balls) ball.center[0] = 0;
        ASSERT_EQ(miniball(balls).center[0], 0);
    }
}

TEST(Miniball, IsWhatASearchOfAllCentresFinds)
{
    Random random(2);
    for (int i = 0; i < 25; ++i) {
        SCOPED_TRACE(i);
        const int width = random.between(1, 12), largest = random.between(0, 100);
        expectSmallest(randomBalls(random, random.between(2, 12), width, largest));
    }
}

/// Voxels of a ball, all its corners alike: any four of them may decide.
TEST(Miniball, OfManyBallsThatDecideAlike)
{
    for (int radiusSq = 2; radiusSq < 60; ++radiusSq) {
        Balls balls;
        for (const auto& voxel : spheretree_test::shapes::ball(radiusSq)) {
            balls.push_back({voxel.asVec3d() + Vec3d(100, 0, -7), 0});
        }
        const RealBall ball = miniball(balls);
        double most = 0;
        for (const RealBall& b : balls) {
            most = std::max(most, (b.center - Vec3d(100, 0, -7)).length());
        }
        expectBall(ball, {100, 0, -7}, most);
    }
}

TEST(Miniball, OfManyBallsDoesNotDependOnTheirOrder)
{
    Random random(3);
    for (int i = 0; i < 20; ++i) {
        Balls balls = randomBalls(random, 3000, 200, 2000);
        const RealBall ball = miniball(balls);
        EXPECT_LE(farthestReach(ball.center, balls), ball.radius * (1 + 1e-12));
        std::reverse(balls.begin(), balls.end());
        expectBall(miniball(balls), ball.center, ball.radius);
    }
}

TEST(Miniball, OfBallsOnALineAndInsideEachOther)
{
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        Balls balls = randomBalls(random, random.between(2, 20), 50, 900);
        double lo = 1e9, hi = -1e9;
        for (RealBall& ball : balls) {
            ball.center = Vec3d(3, 4, 0) / 5.0 * ball.center[0];
            const double at = ball.center.length() * (ball.center[0] < 0 ? -1 : 1);
            lo = std::min(lo, at - ball.radius);
            hi = std::max(hi, at + ball.radius);
        }
        expectBall(miniball(balls), Vec3d(3, 4, 0) / 5.0 * ((lo + hi) / 2), (hi - lo) / 2);
    }
}
