// SPDX-License-Identifier: Apache-2.0
/// @file TestSphereDistances.cc
/// @brief Batches of spheres, against brute force and against single points.

#include "ObjectReference.h"
#include "QuerySamples.h"
#include "support/CoreStages.h"
#include "support/Messages.h"
#include "support/VectorTarget.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/query/PointQuery.h>
#include <openvdb_spheretree/query/SphereDistances.h>

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

constexpr double kRounding = 0x1p-19;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                kInfinity = std::numeric_limits<float>::infinity();

/// Robots: spheres near each other, here and there around a tree; some are switched off.
std::vector<float> randomSpheres(
    Random& random, const std::vector<WorldBall>& balls, int robots, int each)
{
    std::vector<float> spheres;
    for (int c = 0; c < robots; ++c) {
        Vec3d at = randomPoint(random, balls)
            + uniform(random, 0, 1) * sizeOf(balls) * randomDirection(random);
        for (int i = 0; i < each; ++i) {
            at += 0.05 * sizeOf(balls) * randomDirection(random);
            for (int axis = 0; axis < 3; ++axis) spheres.push_back(float(at[axis]));
            spheres.push_back(
                random.chance(0.1) ? -1 : float(0.05 * sizeOf(balls) * uniform(random, 0, 1)));
        }
    }
    return spheres;
}

struct Results {
    explicit Results(std::size_t count)
        : distance(count, kNan), gradient(3 * count, kNan), leaf(count, -7)
    {}
    SphereDistanceArrays arrays() { return {distance.data(), gradient.data(), leaf.data()}; }

    std::vector<float> distance, gradient;
    std::vector<int32_t> leaf;
};

Vec3d centerOf(const std::vector<float>& spheres, std::size_t i)
{
    return Vec3d(spheres[4 * i], spheres[4 * i + 1], spheres[4 * i + 2]);
}

TEST(SphereDistances, AreThoseOfBruteForce)
{
    Random random(41);
    int active = 0;
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree, Exactness::LeafUnion);
        const auto balls = leafBalls(sample.tree);
        const std::vector<float> spheres = randomSpheres(random, balls, 10, 37);
        const std::size_t count = spheres.size() / 4;
        const float activation = float(0.1 * tree.radius());
        Results found(count);
        sphereDistances(tree, spheres.data(), count, activation, found.arrays());
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3d center = centerOf(spheres, i), gradient(found.gradient.data() + 3 * i);
            const double truth = distanceToBalls(center, balls) - spheres[4 * i + 3];
            const double slack =
                kRounding * ((center - tree.center()).length() + 2 * tree.radius());
            ASSERT_LE(found.distance[i], std::max(truth, double(activation))) << sample.name;
            if (spheres[4 * i + 3] < 0 || truth > activation + slack) {
                ASSERT_EQ(found.distance[i], activation);
                ASSERT_EQ(found.leaf[i], -1);
                ASSERT_EQ(gradient, Vec3d(0.0));
            } else if (truth < activation) {
                ASSERT_NEAR(found.distance[i], truth, slack) << sample.name;
                ASSERT_LE(found.distance[i], truth);
                const Vec3d away = center - tree.leafCenter(found.leaf[i]);
                ASSERT_NEAR((gradient - away.unit()).length(), 0, 1e-6);
                ++active;
            }
        }
    }
    EXPECT_GT(active, 500);
}

TEST(SphereDistances, SpheresMuchLargerThanTheTreeAreNotLeftOut)
{
    Random random(44);
    int touch = 0, apart = 0;
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree, Exactness::LeafUnion);
        const auto balls = leafBalls(sample.tree);
        for (const double times : {3.0, 30.0, 300.0, 3000.0}) {
            for (int i = 0; i < 100; ++i) {
                // Tangent to the tree, but for the rounding of its center.
                const double radius = times * tree.radius();
                const Vec3d along = randomDirection(random);
                const double way = -distanceToBalls(tree.center() + 1e3 * radius * along, balls);
                const Vec3d center = tree.center() + (1e3 * radius + way + radius) * along;
                const std::vector<float> sphere = {
                    float(center[0]), float(center[1]), float(center[2]), float(radius)};
                const double gap = distanceToBalls(centerOf(sphere, 0), balls) - sphere[3];
                Results found(1);
                sphereDistances(tree, sphere.data(), 1, 0, found.arrays());
                uint8_t touches = 7;
                spheresTouch(tree, sphere.data(), 1, 1, &touches);
                if (gap < 0) {
                    ASSERT_EQ(touches, 1) << sample.name << " " << times << " " << gap;
                    ASSERT_GE(found.leaf[0], 0) << sample.name << " " << times << " " << gap;
                }
                (gap < 0 ? touch : apart)++;
            }
        }
    }
    EXPECT_GT(touch, 500);
    EXPECT_GT(apart, 500);
}

TEST(SphereDistances, AConfigurationTouchesIfASphereDoes)
{
    Random random(42);
    int touch = 0, apart = 0;
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree);
        const QueryTree exact = makeQueryTree(sample.tree, Exactness::LeafUnion);
        const auto balls = leafBalls(sample.tree);
        const auto object = cubes(sample);
        for (const int each : {1, 8, 70}) {
            const int robots = 30;
            const std::vector<float> spheres = randomSpheres(random, balls, robots, each);
            std::vector<uint8_t> found(robots, 7), foundExact(robots, 7);
            spheresTouch(tree, spheres.data(), robots, each, found.data());
            spheresTouch(exact, spheres.data(), robots, each, foundExact.data());
            for (int c = 0; c < robots; ++c) {
                double toBalls = 1e30, toCubes = 1e30;
                for (int i = c * each; i < (c + 1) * each; ++i) {
                    const double radius = spheres[4 * i + 3];
                    if (radius < 0) continue;
                    toBalls =
                        std::min(toBalls, distanceToBalls(centerOf(spheres, i), balls) - radius);
                    toCubes =
                        std::min(toCubes, distanceToCubes(centerOf(spheres, i), object) - radius);
                }
                const double slack = kRounding * 10 * tree.radius();
                if (toCubes <= 0) {
                    ASSERT_EQ(found[c], 1) << sample.name;
                }
                if (toBalls <= 0) {
                    ASSERT_EQ(foundExact[c], 1) << sample.name;
                }
                if (toBalls > slack) {
                    ASSERT_EQ(found[c] + foundExact[c], 0) << sample.name;
                }
                (found[c] ? touch : apart)++;
            }
        }
    }
    EXPECT_GT(touch, 300);
    EXPECT_GT(apart, 300);
}

TEST(SphereDistances, AreThoseOfPoints)
{
    Random random(43);
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree);
        const auto balls = leafBalls(sample.tree);
        std::vector<float> spheres = randomSpheres(random, balls, 5, 33);
        for (std::size_t i = 3; i < spheres.size(); i += 4) spheres[i] = 0;
        const std::size_t count = spheres.size() / 4;
        Results found(count);
        sphereDistances(tree, spheres.data(), count, kInfinity, found.arrays());
        for (std::size_t i = 0; i < count; ++i) {
            const PointDistance point = nearest(tree, centerOf(spheres, i));
            ASSERT_EQ(found.leaf[i], point.leaf);
            ASSERT_LE(double(found.distance[i]), point.distance);
            ASSERT_GE(std::nextafter(found.distance[i], kInfinity), point.distance);
            ASSERT_EQ(found.gradient[3 * i], float(point.gradient[0]));
        }
    }
}

TEST(SphereDistances, AreTheSameForAnyNumberOfThreadsAndOnEveryVectorTarget)
{
    Random random(44);
    const QuerySample& sample = querySamples()[2];
    const QueryTree tree = makeQueryTree(sample.tree);
    const auto balls = leafBalls(sample.tree);
    const std::vector<float> spheres = randomSpheres(random, balls, 30, 64);
    const std::size_t count = spheres.size() / 4;
    Results first(count);
    std::vector<uint8_t> firstTouch(30);
    sphereDistances(tree, spheres.data(), count, 1, first.arrays());
    spheresTouch(tree, spheres.data(), 30, 64, firstTouch.data());
    const auto expectSame = [&] {
        Results found(count);
        std::vector<uint8_t> touch(30);
        sphereDistances(tree, spheres.data(), count, 1, found.arrays());
        spheresTouch(tree, spheres.data(), 30, 64, touch.data());
        EXPECT_EQ(found.distance, first.distance);
        EXPECT_EQ(found.gradient, first.gradient);
        EXPECT_EQ(found.leaf, first.leaf);
        EXPECT_EQ(touch, firstTouch);
    };
    for (const std::size_t threads : {1, 2, 5}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        expectSame();
    }
    for (const int64_t target : allTargets()) {
        forceTarget(target);
        expectSame();
    }
    forceTarget(0);
}

TEST(SphereDistances, GoOnlyWhereTheyAreWanted)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    const Vec3d at = tree.center();
    const float sphere[4] = {float(at[0]), float(at[1]), float(at[2]), 1};
    float distance = 0, gradient[3];
    int32_t leaf = -7;
    sphereDistances(tree, sphere, 1, 1, {});
    sphereDistances(tree, sphere, 1, 1, {&distance, nullptr, nullptr});
    sphereDistances(tree, sphere, 1, 1, {nullptr, gradient, nullptr});
    sphereDistances(tree, sphere, 1, 1, {nullptr, nullptr, &leaf});
    Results all(1);
    sphereDistances(tree, sphere, 1, 1, all.arrays());
    EXPECT_EQ(all.distance[0], distance);
    EXPECT_EQ(all.gradient[1], gradient[1]);
    EXPECT_EQ(all.leaf[0], leaf);
    sphereDistances(tree, nullptr, 0, 1, {});
    spheresTouch(tree, nullptr, 0, 64, nullptr);
    uint8_t touching = 7; // a robot without spheres
    spheresTouch(tree, nullptr, 1, 0, &touching);
    EXPECT_EQ(touching, 0);
}

TEST(SphereDistances, TakeLargeSpheresAndFarOnes)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    for (const float far : {1e3f, 1e10f, 1e30f, 3e38f}) {
        const float spheres[12] = {far, 0, 0, far / 2, far, 0, 0, far, far, 0, 0, -1};
        Results found(3);
        sphereDistances(tree, spheres, 3, kInfinity, found.arrays());
        EXPECT_EQ(found.leaf[2], -1);
        EXPECT_NEAR(found.distance[0] / (far / 2), 1, 0.05);
        EXPECT_GE(found.leaf[1], 0);
        EXPECT_LE(std::abs(found.distance[1]), 20 + 1e-4 * far);
        uint8_t touching[2];
        spheresTouch(tree, spheres, 2, 1, touching);
        EXPECT_EQ(touching[0], 0);
    }
}

TEST(SphereDistances, RefusesNumbersThatAreNone)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    uint8_t touching;
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
        for (int at = 0; at < 4; ++at) {
            float spheres[8] = {0, 0, 0, 1, 0, 0, 0, 1};
            spheres[4 + at] = bad;
            EXPECT_TRUE(mentions(
                messageOf<openvdb::ValueError>([&] { sphereDistances(tree, spheres, 2, 1, {}); }),
                "sphere 1"));
            spheres[3] = -1; // not found by an early end
            EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>(
                                     [&] { spheresTouch(tree, spheres, 1, 2, &touching); }),
                "sphere 1"));
        }
    }
    const float sphere[4] = {0, 0, 0, 1};
    for (const float bad : {kNan, -1.0f}) {
        EXPECT_TRUE(mentions(
            messageOf<openvdb::ValueError>([&] { sphereDistances(tree, sphere, 1, bad, {}); }),
            "activation="));
    }
}

TEST(SphereDistances, CanBeInterrupted)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    const std::vector<float> spheres(400000, 0.5f);
    Results found(100000);
    StopAfter stop, again;
    EXPECT_THROW(
        sphereDistances(tree, spheres.data(), 100000, 1, found.arrays(), &stop), Interrupted);
    std::vector<uint8_t> touching(100000);
    EXPECT_THROW(
        spheresTouch(tree, spheres.data(), 100000, 1, touching.data(), &again), Interrupted);
}

} // namespace
