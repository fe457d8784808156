// SPDX-License-Identifier: Apache-2.0
/// @file TestPointQuery.cc
/// @brief Distances of points against brute force over all leaf spheres and all voxel cubes.

#include "ObjectReference.h"
#include "QuerySamples.h"
#include "support/Messages.h"
#include "support/VectorTarget.h"

#include <openvdb_spheretree/query/PointQuery.h>

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>
#include <openvdb/math/Transform.h>

#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 0x1p-20; ///< as PointQuery.h says, of distance and size

/// How far an answer may be below the truth.
double roundingAt(const Vec3d& point, const QueryTree& tree)
{
    return kRounding * ((point - tree.center()).length() + 2 * tree.radius());
}

TEST(PointQuery, TheNearestLeafIsThatOfBruteForce)
{
    Random random(11);
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree, Exactness::LeafUnion);
        ASSERT_TRUE(tree.holdsLeaves()) << sample.name;
        const auto balls = leafBalls(sample.tree);
        for (int i = 0; i < 1500; ++i) {
            const Vec3d point = randomPoint(random, balls);
            const double truth = distanceToBalls(point, balls);
            const PointDistance found = nearest(tree, point);
            ASSERT_TRUE(found) << sample.name;
            ASSERT_LE(found.distance, truth) << sample.name;
            ASSERT_GE(found.distance, truth - roundingAt(point, tree)) << sample.name;
            ASSERT_NEAR(
                (point - tree.leafCenter(found.leaf)).length() - tree.leafRadius(found.leaf),
                found.distance, roundingAt(point, tree));
            ASSERT_GT(found.blocks, 0);
        }
    }
}

TEST(PointQuery, TheDistanceIsBetweenThatOfLeavesAndThatOfCubes)
{
    Random random(12);
    int between = 0;
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree);
        ASSERT_TRUE(tree.holdsObject()) << sample.name;
        const auto balls = leafBalls(sample.tree);
        const auto object = cubes(sample);
        for (int i = 0; i < 1500; ++i) {
            const Vec3d point = randomPoint(random, balls);
            const double toLeaves = distanceToBalls(point, balls),
                         toCubes = distanceToCubes(point, object);
            const double found = nearest(tree, point).distance;
            ASSERT_LE(found, toCubes) << sample.name;
            ASSERT_GE(found, toLeaves - roundingAt(point, tree)) << sample.name;
            between += found > toLeaves + roundingAt(point, tree);
        }
    }
    EXPECT_GT(between, 0)
        << "trees with cover=voxels were to leave out leaves that reach out of the object";
}

TEST(PointQuery, TheDistanceOfTheObjectIsBetweenItsBounds)
{
    Random random(21);
    int narrow = 0, all = 0;
    for (const QuerySample& sample : querySamples()) {
        const double voxel = sample.tree.voxelSize();
        const auto balls = leafBalls(sample.tree);
        const auto object = cubes(sample);
        for (const Exactness exactness : {Exactness::Object, Exactness::LeafUnion}) {
            const QueryTree tree = makeQueryTree(sample.tree, exactness);
            for (int i = 0; i < 500; ++i) {
                const Vec3d point = randomPoint(random, balls);
                const double truth = distanceToCubes(point, object);
                const PointDistance found = nearest(tree, point);
                ASSERT_LE(found.objectLower, truth) << sample.name;
                ASSERT_GE(found.objectUpper, truth) << sample.name;
                ASSERT_EQ(found.objectLower, std::max(0.0, found.distance));
                ++all;
                narrow += found.objectUpper - found.objectLower < 1.8 * voxel;
                const double cutoff = uniform(random, 0, 2) * tree.radius();
                const PointDistance near = nearest(tree, point, cutoff);
                ASSERT_LE(near.objectLower, truth) << sample.name;
                ASSERT_GE(near.objectUpper, truth) << sample.name;
                if (near) continue;
                ASSERT_EQ(near.objectLower, cutoff);
                ASSERT_EQ(near.objectUpper, kInfinity);
            }
        }
    }
    EXPECT_EQ(narrow, all) << "leaves reach out of the object by 1.74 voxels at most";
}

TEST(PointQuery, NoPointOfACubeIsOutside)
{
    Random random(13);
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree);
        for (const WorldCube& cube : cubes(sample)) {
            Vec3d point; // mostly corners and points of faces
            for (int axis = 0; axis < 3; ++axis) {
                const double at = std::max(0.0, std::min(1.0, uniform(random, -1, 2)));
                point[axis] = cube.low[axis] + at * (cube.high[axis] - cube.low[axis]);
            }
            ASSERT_LE(nearest(tree, point).distance, 0) << sample.name << point;
            ASSERT_TRUE(meetsBall(tree, point, 0)) << sample.name << point;
        }
    }
}

TEST(PointQuery, TheGradientIsThatOfTheDistance)
{
    Random random(14);
    const QuerySample& sample = querySamples()[1];
    const QueryTree tree = makeQueryTree(sample.tree, Exactness::LeafUnion);
    const auto balls = leafBalls(sample.tree);
    for (int i = 0; i < 500; ++i) {
        const Vec3d point = randomPoint(random, balls);
        const PointDistance found = nearest(tree, point);
        ASSERT_NEAR(found.gradient.length(), 1, 1e-12);
        const double step = 1e-3 * tree.radius();
        const PointDistance moved = nearest(tree, point + step * found.gradient);
        if (moved.leaf != found.leaf) continue;
        ASSERT_NEAR(moved.distance - found.distance, step, 2 * roundingAt(point, tree));
    }
    const Vec3d center = tree.leafCenter(0);
    if (nearest(tree, center).leaf == 0) {
        EXPECT_EQ(nearest(tree, center).gradient, Vec3d(0.0));
    }
}

TEST(PointQuery, ACutOffHidesOnlyWhatIsFarther)
{
    Random random(15);
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree, Exactness::LeafUnion);
        const auto balls = leafBalls(sample.tree);
        for (int i = 0; i < 200; ++i) {
            const Vec3d point = randomPoint(random, balls);
            const double truth = distanceToBalls(point, balls), slack = roundingAt(point, tree);
            const double cutoff = uniform(random, 0, 0.5) * tree.radius();
            const PointDistance found = nearest(tree, point, cutoff);
            if (truth <= cutoff) {
                ASSERT_TRUE(found) << sample.name;
            }
            if (truth > cutoff + slack) {
                ASSERT_FALSE(found) << sample.name;
            }
            ASSERT_LE(found.distance, std::max(truth, cutoff));
            if (found) {
                ASSERT_LE(found.distance, cutoff);
            } else {
                ASSERT_EQ(found.distance, cutoff);
            }
            if (truth > 0 && truth <= cutoff) {
                ASSERT_TRUE(nearest(tree, point, truth));
            }
        }
    }
}

TEST(PointQuery, ABallMeetsWhatIsNoFartherThanItsRadius)
{
    Random random(16);
    int met = 0;
    for (const QuerySample& sample : querySamples()) {
        const QueryTree exact = makeQueryTree(sample.tree, Exactness::LeafUnion);
        const QueryTree tree = makeQueryTree(sample.tree);
        const auto balls = leafBalls(sample.tree);
        const auto object = cubes(sample);
        for (int i = 0; i < 200; ++i) {
            const Vec3d center = randomPoint(random, balls);
            const double radius = uniform(random, 0, 0.3) * exact.radius();
            const double gap = distanceToBalls(center, balls) - radius,
                         slack = roundingAt(center, exact) + kRounding * radius;
            if (gap <= 0) {
                ASSERT_TRUE(meetsBall(exact, center, radius)) << sample.name;
            }
            if (gap > slack) {
                ASSERT_FALSE(meetsBall(exact, center, radius)) << sample.name;
            }
            if (gap > slack) {
                ASSERT_FALSE(meetsBall(tree, center, radius)) << sample.name;
            }
            if (distanceToCubes(center, object) <= radius) {
                ASSERT_TRUE(meetsBall(tree, center, radius)) << sample.name;
            }
            met += gap <= 0;
        }
    }
    EXPECT_GT(met, 100);
}

TEST(PointQuery, ALargeBallIsItsNearSideAndAFarPointItsDirection)
{
    Random random(17);
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree, Exactness::LeafUnion);
        const auto balls = leafBalls(sample.tree);
        for (const double times : {1e2, 1e4, 1e7, 1e12, 1e100}) {
            const Vec3d point = tree.center() + times * tree.radius() * randomDirection(random);
            const double truth = distanceToBalls(point, balls), slack = 0x1p-17 * truth;
            const PointDistance found = nearest(tree, point);
            ASSERT_TRUE(found) << sample.name << times;
            ASSERT_LE(found.distance, truth * (1 + 1e-15));
            ASSERT_GE(found.distance, truth - slack) << sample.name << times;
            ASSERT_TRUE(meetsBall(tree, point, truth * (1 + 1e-15)));
            ASSERT_FALSE(meetsBall(tree, point, truth - slack - tree.radius() / 100))
                << sample.name << times;
            ASSERT_FALSE(nearest(tree, point, truth / 2));
        }
    }
}

/// Bit by bit, with the number of blocks.
void expectSame(const PointDistance& a, const PointDistance& b)
{
    ASSERT_EQ(a.distance, b.distance);
    ASSERT_EQ(a.gradient, b.gradient);
    ASSERT_EQ(a.leaf, b.leaf);
    ASSERT_EQ(a.blocks, b.blocks);
}

TEST(PointQuery, IsTheSameOnEveryVectorTarget)
{
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree);
        const auto balls = leafBalls(sample.tree);
        std::vector<PointDistance> first;
        for (const int64_t target : allTargets()) {
            forceTarget(target);
            Random random(18);
            for (std::size_t i = 0; i < 200; ++i) {
                const Vec3d point = randomPoint(random, balls);
                const PointDistance found =
                    nearest(tree, point, i % 2 ? kInfinity : 0.1 * tree.radius());
                if (first.size() == i) first.push_back(found);
                expectSame(found, first[i]);
            }
        }
    }
    forceTarget(0);
}

TEST(PointQuery, IsTheSameInAMovedWorldWithPermutedAxes)
{
    Random random(19);
    const Vec3d offset(4096, -512, 1024); // exact in floats, so that what is rounded stays alike
    for (const QuerySample& sample : querySamples()) {
        const QueryTree here = makeQueryTree(sample.tree, Exactness::LeafUnion);
        const QueryTree there =
            makeQueryTree(turnedTree(sample.tree, offset), Exactness::LeafUnion);
        const auto balls = leafBalls(sample.tree);
        for (int i = 0; i < 100; ++i) {
            const Vec3d point = randomPoint(random, balls),
                        moved = Vec3d(point[1], point[2], point[0]) + offset;
            ASSERT_NEAR(nearest(here, point).distance, nearest(there, moved).distance,
                2 * roundingAt(point, here))
                << sample.name;
        }
    }
}

TEST(PointQuery, HoldsFarFromTheOriginOfTheWorldToo)
{
    Random random(20);
    for (const double far : {1e3, 1e6, 1e9}) {
        for (const QuerySample& sample : querySamples()) {
            const QuerySample moved{
                sample.name, {}, turnedTree(sample.tree, Vec3d(far, -far, 3 * far))};
            const QueryTree tree = makeQueryTree(moved.tree);
            for (const Coord& voxel : sample.voxels) {
                const Coord there(voxel[1], voxel[2], voxel[0]);
                Vec3d corner;
                for (int axis = 0; axis < 3; ++axis)
                    corner[axis] = there[axis] + (random.chance(0.5) ? 0.5 : -0.5);
                const Vec3d point = moved.tree.transform->indexToWorld(corner);
                // The corner itself is off by the rounding of doubles there.
                ASSERT_LE(nearest(tree, point).distance, 1e-15 * far) << sample.name << far;
                ASSERT_TRUE(meetsBall(tree, point, 1e-15 * far)) << sample.name << far;
            }
        }
    }
}

TEST(PointQuery, RefusesNumbersThatAreNone)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {nan, kInfinity, -kInfinity}) {
        for (int axis = 0; axis < 3; ++axis) {
            Vec3d point(1, 2, 3);
            point[axis] = bad;
            const auto text = messageOf<openvdb::ValueError>([&] { nearest(tree, point); });
            EXPECT_TRUE(mentions(text, "must be finite"));
            EXPECT_THROW(meetsBall(tree, point, 1), openvdb::ValueError);
        }
    }
    for (const double bad : {nan, -1.0, -kInfinity}) {
        const auto text = messageOf<openvdb::ValueError>([&] { nearest(tree, Vec3d(0.0), bad); });
        EXPECT_TRUE(mentions(text, "cutoff="));
        EXPECT_TRUE(mentions(
            messageOf<openvdb::ValueError>([&] { meetsBall(tree, Vec3d(0.0), bad); }), "radius="));
    }
    EXPECT_THROW(meetsBall(tree, Vec3d(0.0), kInfinity), openvdb::ValueError);
}

} // namespace
