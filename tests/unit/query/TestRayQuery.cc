// SPDX-License-Identifier: Apache-2.0
/// @file TestRayQuery.cc
/// @brief Rays against brute force over all leaf spheres and all voxel cubes.

#include "ObjectReference.h"
#include "QuerySamples.h"
#include "support/CoreStages.h"
#include "support/Messages.h"
#include "support/VectorTarget.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/query/QueryData.h>
#include <openvdb_spheretree/query/RayQuery.h>

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRounding = 0x1p-18; ///< as RayQuery.h says, of the tree's size

/// From around a tree, or from in it, towards it or past it; of any length.
QueryRay randomRay(Random& random, const std::vector<WorldBall>& balls)
{
    const Vec3d target = randomPoint(random, balls);
    const double away =
        sizeOf(balls) * (random.chance(0.3) ? uniform(random, 0, 0.5) : uniform(random, 1, 4));
    QueryRay ray;
    ray.origin = target + away * randomDirection(random);
    ray.direction = (target - ray.origin) * uniform(random, 0.1, 3);
    if (random.chance(0.2)) { // along an axis
        const int axis = random.between(0, 2);
        ray.direction = Vec3d(0.0);
        ray.direction[axis] = random.chance(0.5) ? 1 : -1;
        ray.origin = target - away * ray.direction;
    }
    if (random.chance(0.2)) ray.tNear = uniform(random, -1, 1.5);
    if (random.chance(0.2)) ray.tFar = uniform(random, 0, 2);
    return ray;
}

PlainRay plain(const QueryRay& ray) { return {ray.origin, ray.direction, ray.tNear, ray.tFar}; }

TEST(RayQuery, TheFirstLeafIsThatOfBruteForce)
{
    Random random(21);
    int hits = 0, misses = 0;
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree, Exactness::LeafUnion);
        const auto balls = leafBalls(sample.tree);
        for (int i = 0; i < 2000; ++i) {
            const QueryRay ray = randomRay(random, balls);
            const double slack = kRounding * tree.radius();
            const double latest = entryOfBalls(plain(ray), balls);
            PlainRay longer = plain(ray); // where all that rounding may add is in it
            const double more = 2 * slack / ray.direction.length();
            longer.near -= more;
            longer.far += more;
            const double soonest = std::max(ray.tNear, entryOfBalls(longer, balls, slack) - more);
            const RayHit hit = intersect(tree, ray);
            ASSERT_LE(hit.t, latest) << sample.name << i;
            ASSERT_GE(hit.t, soonest) << sample.name << i;
            ASSERT_EQ(bool(hit), hit.t != kInfinity);
            ASSERT_EQ(occluded(tree, ray), bool(hit)) << sample.name << i;
            if (hit) {
                ASSERT_TRUE(hit.t >= ray.tNear && hit.t <= ray.tFar);
            }
            (hit ? hits : misses)++;
        }
    }
    EXPECT_GT(hits, 1000);
    EXPECT_GT(misses, 1000);
}

TEST(RayQuery, HitsAreBetweenThoseOfLeavesAndThoseOfCubes)
{
    Random random(22);
    int later = 0;
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree);
        const auto balls = leafBalls(sample.tree);
        const auto object = cubes(sample);
        for (int i = 0; i < 2000; ++i) {
            const QueryRay ray = randomRay(random, balls);
            const RayHit hit = intersect(tree, ray);
            ASSERT_LE(hit.t, entryOfCubes(plain(ray), object)) << sample.name << i;
            const double slack = kRounding * tree.radius(),
                         more = 2 * slack / ray.direction.length();
            PlainRay longer = plain(ray);
            longer.near -= more;
            longer.far += more;
            const double soonest = entryOfBalls(longer, balls, slack) - more;
            ASSERT_GE(hit.t, std::max(ray.tNear, soonest)) << sample.name << i;
            later += hit.t > entryOfBalls(plain(ray), balls) + more;
        }
    }
    EXPECT_GT(later, 0)
        << "trees with cover=voxels were to leave out leaves that reach out of the object";
}

TEST(RayQuery, EveryCornerOfACubeStopsARay)
{
    Random random(29);
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree);
        for (const WorldCube& cube : cubes(sample)) {
            Vec3d corner;
            for (int axis = 0; axis < 3; ++axis) {
                corner[axis] = (random.chance(0.5) ? cube.low : cube.high)[axis];
            }
            // Ends at the corner, often tangent to the spheres that just hold it; or starts there.
            QueryRay ray;
            ray.direction = randomDirection(random) * uniform(random, 0.1, 10);
            ray.origin = corner - 3 * ray.direction;
            ray.tFar = 3 + 1e-13;
            ASSERT_LE(intersect(tree, ray).t, ray.tFar) << sample.name;
            ASSERT_TRUE(occluded(tree, {corner, ray.direction})) << sample.name;
        }
    }
}

TEST(RayQuery, AHitIsOnItsLeaf)
{
    Random random(23);
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree);
        const auto balls = leafBalls(sample.tree);
        for (int i = 0; i < 100; ++i) {
            const QueryRay ray = randomRay(random, balls);
            const RayHit hit = intersect(tree, ray);
            if (!hit) continue;
            const double off =
                (ray.at(hit.t) - tree.leafCenter(hit.leaf)).length() - tree.leafRadius(hit.leaf);
            ASSERT_LE(off, 2 * kRounding * tree.radius() + 1e-12 * ray.origin.length())
                << sample.name;
            if (hit.t > ray.tNear) {
                ASSERT_GE(off, -2 * kRounding * tree.radius()) << sample.name;
            }
        }
    }
}

TEST(RayQuery, BetweenTwoVoxelsHitsNothing)
{
    // The block of both has empty lanes, which are far along x; rays come along their line.
    TightOptions fast;
    fast.quality = Quality::Fast;
    const QuerySample sample = querySample("two", {Coord(0, -9, 0), Coord(0, 9, 0)}, fast);
    const QueryTree tree = makeQueryTree(sample.tree);
    ASSERT_TRUE(isEmptyLane(tree.data().spheres.blocks[0], detail::kBlockWidth - 1));
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
            QueryRay ray;
            ray.origin = tree.data().origin;
            ray.direction = Vec3d(0.0);
            ray.direction[axis] = sign;
            EXPECT_EQ(bool(intersect(tree, ray)), axis == 1);
            EXPECT_EQ(occluded(tree, ray), axis == 1);
        }
    }
}

TEST(RayQuery, OneThatLeavesItsStartIsNotStoppedThere)
{
    Random random(24);
    int freed = 0;
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree, Exactness::LeafUnion);
        const auto balls = leafBalls(sample.tree);
        const double slack = kRounding * tree.radius();
        for (int i = 0; i < 200; ++i) {
            QueryRay ray;
            ray.origin = randomPoint(random, balls);
            ray.direction = randomDirection(random);
            ray.leavesStart = true;
            std::vector<WorldBall> others; // of those that hold the start by a hair nothing is said
            bool isNearSurface = false;
            for (const WorldBall& ball : balls) {
                const double off = (ray.origin - ball.center).length() - ball.radius;
                if (off > 0) others.push_back(ball);
                isNearSurface |= std::abs(off) < 100 * slack;
            }
            if (isNearSurface) continue;
            const RayHit hit = intersect(tree, ray);
            ASSERT_LE(hit.t, entryOfBalls(plain(ray), others)) << sample.name;
            ASSERT_GE(hit.t, entryOfBalls(plain(ray), others, slack) - 2 * slack) << sample.name;
            ASSERT_EQ(occluded(tree, ray), bool(hit));
            freed += others.size() < balls.size() && !hit;
        }
    }
    EXPECT_GT(freed, 20);
}

TEST(RayQuery, ComesFromFarAwayAsWellAsFromNear)
{
    Random random(25);
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree, Exactness::LeafUnion);
        const auto balls = leafBalls(sample.tree);
        for (int i = 0; i < 50; ++i) {
            QueryRay ray;
            const Vec3d target = randomPoint(random, balls);
            ray.direction = randomDirection(random);
            ray.origin =
                target - std::pow(10, uniform(random, 0, 6.5)) * tree.radius() * ray.direction;
            const double slack = 2 * kRounding * tree.radius();
            const RayHit hit = intersect(tree, ray);
            // Where the origin was rounded, the reference is off as well.
            const double latest = entryOfBalls(plain(ray), balls, -slack),
                         soonest = entryOfBalls(plain(ray), balls, slack);
            ASSERT_LE(hit.t, latest) << sample.name;
            ASSERT_GE(hit.t, soonest - 2 * slack) << sample.name;
        }
    }
}

TEST(RayQuery, IsTheSameInAMovedWorldWithPermutedAxes)
{
    Random random(28);
    const Vec3d offset(4096, -512, 1024);
    const auto turned = [](const Vec3d& v) { return Vec3d(v[1], v[2], v[0]); };
    for (const QuerySample& sample : querySamples()) {
        const QueryTree here = makeQueryTree(sample.tree, Exactness::LeafUnion);
        const SphereTree moved = turnedTree(sample.tree, offset);
        const QueryTree there = makeQueryTree(moved, Exactness::LeafUnion);
        const auto balls = leafBalls(sample.tree);
        for (int i = 0; i < 200; ++i) {
            QueryRay ray = randomRay(random, balls);
            ray.direction.normalize();
            const RayHit a = intersect(here, ray);
            ray.origin = turned(ray.origin) + offset;
            ray.direction = turned(ray.direction);
            const RayHit b = intersect(there, ray);
            // Balls that are grazed are hit or not by rounding, and then much sooner or later.
            const double slack = 2 * kRounding * here.radius();
            const auto there_ = leafBalls(moved);
            const double latest = entryOfBalls(plain(ray), there_, -slack);
            ASSERT_LE(a.t, latest + slack) << sample.name;
            ASSERT_LE(b.t, latest + slack) << sample.name;
            const double soonest = entryOfBalls(plain(ray), there_, slack);
            if (latest - soonest > 10 * slack || std::isinf(latest) != std::isinf(soonest))
                continue;
            if (std::isfinite(latest)) {
                ASSERT_NEAR(a.t, b.t, 20 * slack) << sample.name;
            } else {
                ASSERT_EQ(a.t, b.t) << sample.name;
            }
        }
    }
}

void expectSame(const RayHit& a, const RayHit& b)
{
    ASSERT_EQ(a.t, b.t);
    ASSERT_EQ(a.leaf, b.leaf);
    ASSERT_EQ(a.blocks, b.blocks);
}

TEST(RayQuery, IsTheSameOnEveryVectorTarget)
{
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree);
        const auto balls = leafBalls(sample.tree);
        std::vector<RayHit> first;
        for (const int64_t target : allTargets()) {
            forceTarget(target);
            Random random(26);
            for (std::size_t i = 0; i < 200; ++i) {
                const RayHit hit = intersect(tree, randomRay(random, balls));
                if (first.size() == i) first.push_back(hit);
                expectSame(hit, first[i]);
            }
        }
    }
    forceTarget(0);
}

TEST(RayQuery, ManyAreEachAsOneForAnyNumberOfThreads)
{
    Random random(27);
    const QuerySample& sample = querySamples()[0];
    const QueryTree tree = makeQueryTree(sample.tree);
    const auto balls = leafBalls(sample.tree);
    std::vector<QueryRay> rays;
    for (int i = 0; i < 1001; ++i) rays.push_back(randomRay(random, balls));
    for (const std::size_t threads : {1, 2, 5}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        std::vector<RayHit> hits(rays.size());
        std::vector<uint8_t> blocked(rays.size(), 7);
        intersect(tree, rays.data(), rays.size(), hits.data());
        occluded(tree, rays.data(), rays.size(), blocked.data());
        for (std::size_t i = 0; i < rays.size(); ++i) {
            expectSame(hits[i], intersect(tree, rays[i]));
            ASSERT_EQ(blocked[i], bool(hits[i]));
        }
    }
    intersect(tree, nullptr, 0, nullptr);
}

TEST(RayQuery, ManyCanBeInterrupted)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    const std::vector<QueryRay> rays(
        100000, QueryRay{tree.center() - Vec3d(100, 0, 0), Vec3d(1, 0, 0)});
    std::vector<RayHit> hits(rays.size());
    StopAfter stop;
    EXPECT_THROW(intersect(tree, rays.data(), rays.size(), hits.data(), &stop), Interrupted);
}

TEST(RayQuery, HitsTheSamePointByADirectionOfAnyLength)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    const Vec3d start = tree.center() - Vec3d(100, 70, 40);
    const Vec3d towards = tree.leafCenter(0) - start;
    const RayHit unit = intersect(tree, QueryRay{start, towards});
    ASSERT_TRUE(unit);
    for (const double length : {1e-290, 1e-200, 1e-152, 1e-148, 1e148, 1e152, 1e200, 1e305}) {
        QueryRay ray{start, towards * length};
        const RayHit hit = intersect(tree, ray);
        ASSERT_TRUE(hit && occluded(tree, ray)) << length;
        EXPECT_EQ(hit.leaf, unit.leaf) << length;
        EXPECT_NEAR(hit.t * length, unit.t, 1e-9) << length;
        ray.tFar = 0.5 * unit.t / length;
        EXPECT_FALSE(intersect(tree, ray)) << length;
        ray.tFar = 2 * unit.t / length;
        ray.tNear = 0.5 * unit.t / length;
        EXPECT_TRUE(occluded(tree, ray)) << length;
        ray = {start, -ray.direction};
        EXPECT_FALSE(occluded(tree, ray)) << length;
    }
}

TEST(RayQuery, RefusesWhatIsNoRay)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const QueryRay sound{tree.center() - Vec3d(100, 0, 0), Vec3d(1, 0, 0)};
    const auto whyNot = [&](const QueryRay& ray) {
        EXPECT_THROW(occluded(tree, ray), openvdb::ValueError);
        return messageOf<openvdb::ValueError>([&] { intersect(tree, ray); });
    };
    for (const Vec3d& bad : {Vec3d(0.0), Vec3d(1, nan, 0), Vec3d(nan), Vec3d(kInfinity, 0, 0)}) {
        QueryRay ray = sound;
        ray.direction = bad;
        EXPECT_TRUE(mentions(whyNot(ray), "points nowhere"));
    }
    QueryRay shortest = sound;
    shortest.direction = Vec3d(5e-324, 0, 0);
    EXPECT_TRUE(mentions(whyNot(shortest), "so short a direction"));
    for (const Vec3d& bad : {Vec3d(nan, 0, 0), Vec3d(0, kInfinity, 0), Vec3d(0, 0, 1e100)}) {
        QueryRay ray = sound;
        ray.origin = bad;
        EXPECT_TRUE(mentions(whyNot(ray), "too far"));
    }
    for (const double bad : {nan, kInfinity, -kInfinity}) {
        QueryRay ray = sound;
        ray.tNear = bad;
        EXPECT_TRUE(mentions(whyNot(ray), "tNear"));
    }
    QueryRay ray = sound;
    ray.tFar = nan;
    EXPECT_TRUE(mentions(whyNot(ray), "tFar"));

    std::vector<QueryRay> rays(50, sound);
    rays[41].direction = Vec3d(0.0);
    std::vector<RayHit> hits(rays.size());
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>(
                             [&] { intersect(tree, rays.data(), rays.size(), hits.data()); }),
        "ray 41"));
}

TEST(RayQuery, OfNoPointsHitsNothing)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    QueryRay ray{tree.leafCenter(0) - Vec3d(100, 0, 0), Vec3d(1, 0, 0)};
    ASSERT_TRUE(intersect(tree, ray));
    ray.tNear = 200;
    ray.tFar = 0;
    EXPECT_FALSE(intersect(tree, ray));
    ray.tFar = kInfinity;
    EXPECT_FALSE(intersect(tree, ray));
    ray.tNear = 0;
    ray.tFar = -kInfinity;
    EXPECT_FALSE(intersect(tree, ray));
}

} // namespace
