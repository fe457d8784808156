// SPDX-License-Identifier: Apache-2.0
/// @file TestRayScene.cc
/// @brief What a ray hits first and what blocks it, against a loop over all shapes; and voxels of a
/// leaf node against a loop over its voxels.

#include "support/RandomObjects.h"

#include <openvdb_spheretree/picture/RayScene.h>
#include <openvdb_spheretree/picture/RayShapes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace {

using namespace openvdb_spheretree::detail;
using openvdb::Coord;
using openvdb::Vec3d;
using openvdb_spheretree::Distance;
using spheretree_test::Random;

Vec3d randomPoint(Random& random, int reach)
{
    constexpr int kUnit = 1 << 10;
    return random.coord(-reach * kUnit, reach * kUnit).asVec3d() / kUnit;
}

Ray randomRay(Random& random, int reach)
{
    const Vec3d from = randomPoint(random, reach);
    Vec3d along = randomPoint(random, reach) - from;
    if (random.chance(0.2)) along[random.between(0, 2)] = 0;
    return Ray(from, along.isZero() ? Vec3d(0, 0, 1) : along.unit());
}

/// The textbook formula, which shares nothing with that of the scene.
double entryOfBall(const Ray& ray, const BallShape& ball)
{
    const Vec3d o = ray.origin - ball.center;
    const double b = 2 * o.dot(ray.direction);
    const double c = o.dot(o) - ball.radius * ball.radius;
    const double d = b * b - 4 * c;
    return d < 0 ? -1 : (-b - std::sqrt(d)) / 2;
}

template <typename Shape>
void expectAsLoop(const std::vector<Shape>& shapes, const Ray& ray, const RayScene<Shape>& scene)
{
    double nearest = -1;
    int32_t shape = -1;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const double t = shapes[i].entry(ray);
        if (t < 0 || (shape >= 0 && t >= nearest)) continue;
        nearest = t;
        shape = int32_t(i);
    }
    const auto hit = scene.nearest(ray);
    ASSERT_EQ(hit.has_value(), shape >= 0);
    EXPECT_EQ(scene.isBlocked(ray), shape >= 0);
    if (!hit) return;
    EXPECT_EQ(hit->shape, shape);
    EXPECT_EQ(hit->distance, nearest);
    EXPECT_NEAR(hit->normal.length(), 1, 1e-9);
    EXPECT_TRUE(scene.isBlocked(ray, nearest * (1 + 1e-12) + 1e-12));
    EXPECT_FALSE(scene.isBlocked(ray, nearest));
}

void expectNearestOf(
    const std::vector<BallShape>& balls, const Ray& ray, const RayScene<BallShape>& scene)
{
    for (const BallShape& ball : balls) {
        const double t = ball.entry(ray), expected = entryOfBall(ray, ball);
        EXPECT_NEAR(t < 0 ? -1 : t, expected < 0 ? -1 : expected, 1e-6);
    }
    expectAsLoop(balls, ray, scene);
}

/// N(x) - radius along a ray falls, then rises: the entry is found by bisection before its lowest
/// point, which is found by thirds. Nothing where the ray starts inside or passes by a hair.
struct NormOracle {
    NormOracle(const Distance& distance, const NormBallShape& shape, const Ray& ray)
        : norm(distance), ball(shape), line(ray)
    {
        double lo = 0, hi = 1e4;
        for (int i = 0; i < 300; ++i) {
            const double third = (hi - lo) / 3;
            if (beyond(lo + third) < beyond(hi - third)) hi -= third;
            else lo += third;
        }
        const double lowest = beyond(lo);
        isClear = std::abs(lowest) > 1e-6 && std::abs(beyond(0)) > 1e-6;
        if (lowest > 0 || beyond(0) < 0) return;
        double outside = 0, inside = lo;
        for (int i = 0; i < 100; ++i) {
            const double middle = (outside + inside) / 2;
            (beyond(middle) > 0 ? outside : inside) = middle;
        }
        entry = inside;
    }
    double beyond(double t) const { return length(line.at(t) - ball.center) - ball.radius; }
    double length(const Vec3d& x) const { return norm.length(x[0], x[1], x[2]) / norm.unit(); }

    Distance norm;
    NormBallShape ball;
    Ray line;
    bool isClear = false;
    double entry = kNoEntry;
};

const std::vector<Distance> kNorms = {Distance::l1(), Distance::linf(), Distance::chamfer(3, 4, 5),
    Distance::chamfer(5, 7, 9), Distance::chamfer(10, 14, 17), Distance::chamfer(2, 3, 3)};

} // namespace

TEST(RayScene, TheNearestOfManyBallsIsThatOfALoopOverAll)
{
    for (uint32_t seed = 1; seed <= 12; ++seed) {
        Random random(seed);
        std::vector<BallShape> balls;
        const int largest = seed % 3 == 0 ? 40 * 1024 : 3 * 1024; // crowded, or with gaps
        for (int count = 1 << seed; count > 0; --count) {
            const Vec3d center = randomPoint(random, 100);
            balls.push_back({center, random.between(100, largest) / 1024.0});
        }
        for (int i = random.between(0, 5); i > 0; --i) balls.push_back(balls[0]); // ties
        const RayScene<BallShape> scene(balls, nullptr);
        const int rays = seed < 10 ? 2000 : 300;
        for (int i = 0; i < rays; ++i) expectNearestOf(balls, randomRay(random, 130), scene);
    }
}

/// A ball that counts how often it is held against a ray.
struct CountedBall : BallShape {
    double entry(const Ray& ray) const
    {
        ++sEntries;
        return BallShape::entry(ray);
    }
    static int64_t sEntries;
};
int64_t CountedBall::sEntries = 0;

static int64_t entriesOf(const std::vector<CountedBall>& balls, const std::vector<Ray>& rays)
{
    const RayScene<CountedBall> scene(balls, nullptr);
    CountedBall::sEntries = 0;
    for (const Ray& ray : rays) scene.nearest(ray);
    return CountedBall::sEntries;
}

/// The cost is that of the shapes near the ray: neither of all, nor of the box around them.
TEST(RayScene, ARayMeetsFewOfManyShapesAndFarOnesAddNothing)
{
    Random random(20);
    std::vector<CountedBall> balls;
    for (int i = 0; i < 20000; ++i) balls.push_back({{randomPoint(random, 100), 1.5}});
    std::vector<Ray> rays;
    for (int i = 0; i < 500; ++i) rays.push_back(randomRay(random, 130));
    const int64_t near = entriesOf(balls, rays);
    EXPECT_LT(near, int64_t(rays.size()) * 200) << "a hundredth of all balls";
    balls.push_back({{Vec3d(1 << 27, 1 << 27, -(1 << 27)), 100}});
    EXPECT_LE(entriesOf(balls, rays), near + 8 * int64_t(rays.size())) << "a leaf of the tree more";
}

TEST(RayScene, OfEqualBallsTheFirstIsHit)
{
    const std::vector<BallShape> balls(100, {Vec3d(0.0), 2});
    const RayScene<BallShape> scene(balls, nullptr);
    const auto hit = scene.nearest(Ray(Vec3d(0, 0, 9), Vec3d(0, 0, -1)));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->shape, 0);
    EXPECT_EQ(hit->distance, 7);
    EXPECT_EQ(hit->normal, Vec3d(0, 0, 1));
}

TEST(RayScene, ABallThatHoldsTheEyeIsLookedOutOf)
{
    const RayScene<BallShape> scene({{Vec3d(0.0), 5}, {Vec3d(0, 0, -20), 1}}, nullptr);
    const auto hit = scene.nearest(Ray(Vec3d(0.0), Vec3d(0, 0, -1)));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->shape, 1);
}

TEST(RayScene, WithoutShapesNothingIsHit)
{
    const RayScene<BallShape> scene({}, nullptr);
    EXPECT_FALSE(scene.nearest(Ray(Vec3d(0.0), Vec3d(0, 0, 1))));
    EXPECT_FALSE(scene.isBlocked(Ray(Vec3d(0.0), Vec3d(0, 0, 1))));
}

TEST(RayScene, ManyBallsInOnePlaceAndOthersFarOffAreFound)
{
    std::vector<BallShape> balls(5000, {Vec3d(1, 2, 3), 0.5});
    for (int i = 0; i < 60; ++i) balls.push_back({Vec3d(std::ldexp(1.0, i / 2), 0, 0), 0.25});
    const RayScene<BallShape> scene(balls, nullptr);
    for (std::size_t i = 5000; i < balls.size(); i += 2) {
        const Vec3d& center = balls[i].center;
        const auto hit = scene.nearest(Ray(center + Vec3d(0, 1, 0), Vec3d(0, -1, 0)));
        ASSERT_TRUE(hit);
        EXPECT_EQ(balls[hit->shape].center, center);
    }
}

TEST(NormBallShape, IsEnteredWhereBisectionFindsItsRadius)
{
    Random random(7);
    int hits = 0;
    for (const Distance& norm : kNorms) {
        const NormFaces faces(norm);
        for (int i = 0; i < 3000; ++i) {
            const double radius = random.between(512, 9 * 1024) / 1024.0;
            const NormBallShape ball{randomPoint(random, 6), radius, &faces};
            const Ray ray = randomRay(random, 20);
            const NormOracle oracle(norm, ball, ray);
            if (!oracle.isClear) continue;
            ASSERT_NEAR(ball.entry(ray), oracle.entry, 1e-9) << toString(norm) << ", ray " << i;
            hits += oracle.entry >= 0;
        }
    }
    EXPECT_GT(hits, 1500);
}

TEST(NormBallShape, TheWholeBallIsBehindTheFaceThatIsHit)
{
    Random random(8);
    for (const Distance& norm : kNorms) {
        const NormFaces faces(norm);
        const NormBallShape ball{randomPoint(random, 6), 5, &faces};
        for (int i = 0; i < 2000; ++i) {
            const Ray ray = randomRay(random, 20);
            const double t = ball.entry(ray);
            if (t < 0) continue;
            const Vec3d normal = ball.normal(ray, t), point = ray.at(t);
            ASSERT_NEAR(normal.length(), 1, 1e-12);
            ASSERT_LT(normal.dot(ray.direction), 0);
            for (int k = 0; k < 20; ++k) {
                Vec3d inside = randomPoint(random, 3);
                if (k % 4 == 0) inside[k / 4 % 3] = 0;
                inside *= 5 * norm.unit() / norm.length(inside[0], inside[1], inside[2]);
                ASSERT_LE(normal.dot(ball.center + inside - point), 1e-9) << toString(norm);
            }
        }
    }
}

TEST(NormBallShape, HasAsManyFacesAsItsNorm)
{
    std::vector<std::size_t> pairs;
    for (const Distance& norm : kNorms) pairs.push_back(NormFaces(norm).normals.size());
    EXPECT_EQ(pairs, (std::vector<std::size_t>{4, 3, 12, 12, 24, 12}));
}

TEST(NormBallShape, TheNearestOfManyIsThatOfALoopOverAll)
{
    for (uint32_t seed = 1; seed <= 12; ++seed) {
        Random random(seed);
        const NormFaces faces(kNorms[seed % kNorms.size()]);
        std::vector<NormBallShape> balls;
        const int largest = seed % 3 == 0 ? 40 * 1024 : 3 * 1024; // crowded, or with gaps
        for (int count = 1 << (seed + 1) / 2; count > 0; --count) {
            const Vec3d center = randomPoint(random, 100);
            balls.push_back({center, random.between(100, largest) / 1024.0, &faces});
        }
        const RayScene<NormBallShape> scene(balls, nullptr);
        for (int i = 0; i < 1000; ++i) expectAsLoop(balls, randomRay(random, 130), scene);
    }
}

TEST(VoxelShape, ALeafIsEnteredWhereTheFirstOfItsVoxelsIs)
{
    Random random(5);
    for (const double rate : {0.002, 0.05, 0.3, 0.9}) {
        openvdb::BoolTree::LeafNodeType leaf;
        leaf.setValueOn(random.between(0, 511));
        for (int i = 0; i < 512; ++i) {
            if (random.chance(rate)) leaf.setValueOn(i);
        }
        openvdb::CoordBBox box;
        leaf.evalActiveBoundingBox(box);
        const Vec3d halfVoxel(0.5);
        VoxelShape shape{
            box.min().asVec3d() - halfVoxel, box.max().asVec3d() + halfVoxel, Vec3d(-0.5), &leaf};
        for (int i = 0; i < 3000; ++i) {
            const Ray ray = randomRay(random, 20);
            double nearest = kNoEntry;
            for (auto voxel = leaf.cbeginValueOn(); voxel; ++voxel) {
                const Vec3d low = voxel.getCoord().asVec3d() - halfVoxel;
                const double t = VoxelShape{low, low + Vec3d(1.0), low, nullptr}.entry(ray);
                if (t >= 0 && (nearest < 0 || t < nearest)) nearest = t;
            }
            ASSERT_EQ(shape.entry(ray), nearest) << rate << ", ray " << i;
        }
    }
}

TEST(VoxelShape, AFullLeafIsEnteredAsATileIs)
{
    Random random(6);
    openvdb::BoolTree::LeafNodeType leaf;
    leaf.setValuesOn();
    const Vec3d lo(-0.5), hi(7.5);
    const VoxelShape voxels{lo, hi, lo, &leaf}, tile{lo, hi, lo, nullptr};
    for (int i = 0; i < 20000; ++i) {
        const Ray ray = randomRay(random, 20);
        const double t = tile.entry(ray);
        if (openvdb::BBoxd(lo, hi).isInside(ray.origin)) continue; // looks out of one voxel or all
        ASSERT_EQ(voxels.entry(ray), t);
        if (t < 0) continue;
        const Vec3d normal = tile.normal(ray, t), point = ray.at(t);
        ASSERT_LT(normal.dot(ray.direction), 0);
        ASSERT_NEAR(point.dot(normal), normal.dot(Vec3d(1.0)) > 0 ? 7.5 : 0.5, 1e-9);
    }
}
