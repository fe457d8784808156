// SPDX-License-Identifier: Apache-2.0
/// @file TestTreeKinds.cc
/// @brief Answers of trees of every other kind (otherQuerySamples()) against brute force over their leaf spheres, and over the
/// voxel cubes of those that hold them.

#include "ObjectReference.h"
#include "PosePairs.h"
#include "QuerySamples.h"
#include "support/Messages.h"

#include <openvdb_spheretree/query/ContinuousCollide.h>
#include <openvdb_spheretree/query/DigitalLeaves.h>
#include <openvdb_spheretree/query/PointQuery.h>
#include <openvdb_spheretree/query/RayQuery.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

/// Leaves grow by rounding to floats.
constexpr double kRounding = 1e-4;

/// What stands before the name of the object.
std::string kindOf(const QuerySample& sample)
{
    return sample.name.substr(0, sample.name.find(" of object"));
}

bool isReversible(const QuerySample& sample)
{
    return kindOf(sample).find("reversible") == 0 && sample.tree.levels.size() > 1;
}

/// Those whose own spheres answer for the object.
std::vector<QuerySample> samplesThatHoldObjects()
{
    std::vector<QuerySample> held;
    for (const QuerySample& sample : otherQuerySamples()) {
        if (isReversible(sample)) continue;
        if (makeQueryTree(sample, Exactness::Object).holdsObject()) held.push_back(sample);
    }
    return held;
}

/// @return why these have no digital leaves; nothing where they do.
std::string whyNotDigital(const SphereTree& tree, const QueryTreeSettings& settings)
{
    try {
        const DigitalLeaves leaves(tree, settings);
        return "";
    } catch (const openvdb::ValueError& error) {
        return error.what();
    }
}

} // namespace

TEST(TreeKinds, AreAllThere)
{
    std::map<std::string, int> kinds;
    for (const QuerySample& sample : otherQuerySamples()) ++kinds[kindOf(sample)];
    EXPECT_EQ(kinds.size(), 10u);
    std::set<std::string> holding;
    for (const QuerySample& sample : samplesThatHoldObjects()) holding.insert(kindOf(sample));
    for (const char* kind : {"extended on miniballs", "given leaves", "a coarser level", "scaled"})
        EXPECT_EQ(holding.count(kind), 1u) << kind;
    for (const char* kind : {"given", "no padding", "flat", "inner"})
        EXPECT_EQ(holding.count(kind), 0u) << kind;
}

TEST(TreeKinds, ThoseWhoseSpheresHoldNothingBelowThemAreRefusedWithTheReason)
{
    int refused = 0;
    for (const QuerySample& sample : otherQuerySamples()) {
        if (!isReversible(sample)) continue;
        ++refused;
        const std::string why =
            messageOf<openvdb::ValueError>([&] { makeQueryTree(sample, Exactness::Object); });
        EXPECT_TRUE(mentions(why, "do not hold those below them")) << sample.name;
        EXPECT_TRUE(makeQueryTree(sample, Exactness::LeafUnion).holdsLeaves());
    }
    EXPECT_GT(refused, 3);
}

TEST(TreeKinds, TwoBodiesMeetAsAllPairsOfTheirLeavesDo)
{
    int touching = 0, apart = 0;
    forEachPosePairOf(otherQuerySamples(), Exactness::LeafUnion, 5000, [&](const PosePair& pair) {
        const double truth = pair.smallestGap();
        if (std::abs(truth) > kRounding) {
            ASSERT_EQ(pair.collide().isCollision(), truth < 0) << pair.name() << truth;
        }
        (truth < 0 ? touching : apart) += 1;
        DistanceRequest request;
        request.enableSignedDistance = true;
        const DistanceResult result = pair.distance(request);
        ASSERT_NEAR(result.distance, truth, kRounding) << pair.name();
        ASSERT_NEAR(pair.gapOf(result.contact->nodes), truth, kRounding) << pair.name();
    });
    EXPECT_GT(touching, 1000);
    EXPECT_GT(apart, 1000);
}

TEST(TreeKinds, AllPairsAreThoseOfAllLeaves)
{
    forEachPosePairOf(otherQuerySamples(), Exactness::LeafUnion, 1000, [&](const PosePair& pair) {
        std::set<std::pair<int32_t, int32_t>> found;
        pair.collideAll(0, [&](const NodePair* pairs, int count) {
            for (int i = 0; i < count; ++i) {
                EXPECT_TRUE(found.insert({pairs[i].a, pairs[i].b}).second) << pair.name();
                EXPECT_LE(pair.gapOf(pairs[i]), kRounding) << pair.name();
            }
            return true;
        });
        const std::vector<double> gaps = pair.allGaps();
        const auto certain =
            std::count_if(gaps.begin(), gaps.end(), [](double gap) { return gap < -kRounding; });
        ASSERT_GE(int64_t(found.size()), int64_t(certain)) << pair.name();
    });
}

TEST(TreeKinds, NoTwoCubesMeetThatAreSaidToBeApart)
{
    int met = 0, apart = 0;
    forEachPosePairOf(samplesThatHoldObjects(), Exactness::Object, 2000, [&](const PosePair& pair) {
        CollisionRequest request;
        request.decideObjects = true;
        const CollisionResult result = pair.collide(request);
        const bool cubesMeet = pair.cubesMeet();
        ASSERT_FALSE(cubesMeet && result.verdict == Verdict::Apart) << pair.name();
        ASSERT_FALSE(cubesMeet && result.objects == Verdict::Apart) << pair.name();
        ASSERT_FALSE(!cubesMeet && result.objects == Verdict::Touching) << pair.name();
        const double cubes = cubesMeet ? 0 : pair.cubesDistanceAtMost();
        const DistanceResult near = pair.distance();
        ASSERT_LE(near.distance, cubes + 1e-9) << pair.name();
        ASSERT_LE(near.objectsLower, cubes + 1e-9) << pair.name();
        // Corners and cubes: edges that pass each other are a little nearer than that.
        const auto side = [](const QueryBody& body) {
            return body.sample.settings.scale * body.tree.voxelSize();
        };
        const double edges = 0.5 * std::sqrt(2.0) * (side(pair.a) + side(pair.b));
        ASSERT_GE(near.objectsUpper, cubes - edges) << pair.name();
        (result.verdict == Verdict::Apart ? apart : met) += 1;
    });
    EXPECT_GT(met, 500);
    EXPECT_GT(apart, 500);
}

TEST(TreeKinds, NothingIsPromisedOfObjectsThatAreNotHeld)
{
    for (const QuerySample& sample : otherQuerySamples()) {
        const std::string kind = kindOf(sample);
        if (kind != "given" && kind != "no padding" && kind != "flat" && kind != "inner") continue;
        const QueryTree tree = makeQueryTree(sample, Exactness::LeafUnion);
        const auto away = RigidTransform::fromTranslation(Vec3d(3 * tree.radius(), 0, 0));
        EXPECT_EQ(collide(tree, {}, tree, away).verdict, Verdict::Apart) << sample.name;
        EXPECT_EQ(collide(tree, {}, tree, away).objects, Verdict::Undecided) << sample.name;
        EXPECT_EQ(distance(tree, {}, tree, away).objectsLower, 0) << sample.name;
    }
}

TEST(TreeKinds, NothingMeetsBeforeTheTime)
{
    Random random(4);
    int met = 0;
    forEachPosePairOf(otherQuerySamples(), Exactness::LeafUnion, 300, [&](const PosePair& pair) {
        const double both = pair.a.query.radius() + pair.b.query.radius();
        const Vec3d away = 2 * both * randomDirection(random);
        const auto motion =
            RigidMotion::screw(RigidTransform::fromTranslation(away) * pair.poseB, pair.poseB);
        ContinuousCollisionRequest request;
        request.tolerance = 1e-3;
        const auto result =
            continuousCollide(pair.a.query, pair.poseA, pair.b.query, motion, request);
        const auto gapAt = [&](double time) {
            return PosePair{pair.a, pair.b, pair.poseA, motion.at(time)}.smallestGap();
        };
        met += result.isCollide;
        for (int k = 0; k < 50 && result.timeOfContact > 0; ++k)
            ASSERT_GT(gapAt(result.timeOfContact * k / 50), -kRounding) << pair.name();
        if (result.isCollide) {
            ASSERT_LE(gapAt(result.timeOfContact), 1e-3 + kRounding) << pair.name();
        }
    });
    EXPECT_GT(met, 100);
}

TEST(TreeKinds, PointsAreAsFarAsFromTheNearestLeaf)
{
    Random random(5);
    for (const QuerySample& sample : otherQuerySamples()) {
        const QueryTree tree = makeQueryTree(sample, Exactness::LeafUnion);
        const auto balls = leafBalls(sample);
        for (int i = 0; i < 300; ++i) {
            const Vec3d point = randomPoint(random, balls);
            const double truth = distanceToBalls(point, balls);
            const double found = nearest(tree, point).distance;
            ASSERT_LE(found, truth) << sample.name;
            ASSERT_GE(found, truth - kRounding) << sample.name;
        }
    }
}

TEST(TreeKinds, RaysEnterTheFirstLeaf)
{
    Random random(6);
    int hits = 0;
    for (const QuerySample& sample : otherQuerySamples()) {
        const QueryTree tree = makeQueryTree(sample, Exactness::LeafUnion);
        const auto balls = leafBalls(sample);
        for (int i = 0; i < 300; ++i) {
            const Vec3d target = randomPoint(random, balls);
            const Vec3d origin = target + 2 * tree.radius() * randomDirection(random);
            const QueryRay ray{origin, (target - origin).unit()};
            const PlainRay plain{ray.origin, ray.direction, ray.tNear, ray.tFar};
            const RayHit hit = intersect(tree, ray);
            ASSERT_LE(hit.t, entryOfBalls(plain, balls)) << sample.name;
            ASSERT_GE(hit.t, entryOfBalls(plain, balls, kRounding) - kRounding) << sample.name;
            ASSERT_EQ(occluded(tree, ray), bool(hit)) << sample.name;
            hits += bool(hit);
        }
    }
    EXPECT_GT(hits, 1000);
}

TEST(TreeKinds, PointsAndRaysMissNoCubeThatIsHeld)
{
    Random random(7);
    for (const QuerySample& sample : samplesThatHoldObjects()) {
        const QueryTree tree = makeQueryTree(sample, Exactness::Object);
        const auto balls = leafBalls(sample);
        const auto object = cubes(sample);
        for (int i = 0; i < 300; ++i) {
            const Vec3d point = randomPoint(random, balls);
            ASSERT_LE(nearest(tree, point).distance, distanceToCubes(point, object)) << sample.name;
            const Vec3d origin = point + 2 * tree.radius() * randomDirection(random);
            const QueryRay ray{origin, point - origin};
            const PlainRay plain{ray.origin, ray.direction, ray.tNear, ray.tFar};
            ASSERT_LE(intersect(tree, ray).t, entryOfCubes(plain, object)) << sample.name;
        }
    }
}

TEST(TreeKinds, TheDistanceOfTheObjectIsBetweenItsBounds)
{
    Random random(9);
    std::set<std::string> bounded;
    for (const QuerySample& sample : otherQuerySamples()) {
        if (kindOf(sample) == "given") continue; // has no object
        const QueryTree tree = makeQueryTree(sample, Exactness::LeafUnion);
        const auto balls = leafBalls(sample);
        const auto object = cubes(sample);
        for (int i = 0; i < 300; ++i) {
            const Vec3d point = randomPoint(random, balls);
            const double truth = distanceToCubes(point, object);
            const PointDistance found = nearest(tree, point);
            ASSERT_LE(found.objectLower, truth) << sample.name;
            ASSERT_GE(found.objectUpper, truth) << sample.name;
            if (std::isfinite(found.objectUpper)) bounded.insert(kindOf(sample));
            if (!tree.holdsObject()) {
                ASSERT_EQ(found.objectLower, 0) << sample.name;
            }
        }
    }
    for (const char* kind :
        {"reversible", "extended on miniballs", "scaled", "no padding", "inner"})
        EXPECT_EQ(bounded.count(kind), 1u) << kind;
    for (const char* kind : {"given leaves", "flat"}) EXPECT_EQ(bounded.count(kind), 0u) << kind;
}

/// Exactly, or with the reason why not.
TEST(TreeKinds, PointsAreInTheObjectWhereLeavesAreItsBalls)
{
    Random random(8);
    std::set<std::string> exact;
    for (const QuerySample& sample : otherQuerySamples()) {
        QueryTreeSettings settings = sample.settings;
        settings.exactness = Exactness::LeafUnion;
        const std::string why = whyNotDigital(sample.tree, settings);
        if (!why.empty()) {
            EXPECT_TRUE(mentions(why, "are not the voxels of its object")) << why;
            continue;
        }
        exact.insert(kindOf(sample));
        const QueryTree tree = makeQueryTree(sample.tree, settings);
        const DigitalLeaves leaves(sample.tree, settings);
        const std::set<Coord> object(sample.voxels.begin(), sample.voxels.end());
        openvdb::CoordBBox box;
        for (const Coord& voxel : sample.voxels) box.expand(voxel);
        box.expand(1);
        for (auto voxel = box.begin(); voxel; ++voxel) {
            const Vec3d center = leaves.center(*voxel);
            ASSERT_EQ(contains(tree, leaves, center), object.count(*voxel) == 1)
                << sample.name << *voxel;
        }
    }
    for (const char* kind : {"reversible", "reversible on miniballs", "extended on miniballs",
             "scaled", "no padding", "flat"})
        EXPECT_EQ(exact.count(kind), 1u) << kind;
    for (const char* kind : {"given", "given leaves", "a coarser level", "inner"})
        EXPECT_EQ(exact.count(kind), 0u) << kind;
}
