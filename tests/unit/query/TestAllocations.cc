// SPDX-License-Identifier: Apache-2.0
/// @file TestAllocations.cc
/// @brief No question takes memory, but for a list that is its result.

#include "CountedAllocations.h"
#include "PosePairs.h"
#include "QuerySamples.h"
#include "support/Sanitizers.h"

#include <openvdb_spheretree/query/BodyDistance.h>
#include <openvdb_spheretree/query/Collide.h>
#include <openvdb_spheretree/query/ContinuousCollide.h>
#include <openvdb_spheretree/query/DigitalLeaves.h>
#include <openvdb_spheretree/query/PointQuery.h>
#include <openvdb_spheretree/query/RayQuery.h>
#include <openvdb_spheretree/query/SphereDistances.h>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

} // namespace

TEST(Allocations, OfTwoBodiesAreNone)
{
    CollisionRequest all;
    all.enableContact = all.enableDistanceLowerBound = all.decideObjects = true;
    all.securityMargin = 0.1;
    CollisionRequest several;
    several.maxContacts = 64;
    std::vector<Contact> contacts;
    contacts.reserve(64);
    int pairs = 0, touching = 0;
    const ContactCallback count = [&](const NodePair*, int found) { return (pairs += found) > 0; };
    for (const Exactness exactness : {Exactness::Object, Exactness::LeafUnion}) {
        forEachPosePair(exactness, 600, [&](const PosePair& pair) {
            ASSERT_EQ(0, allocationsOf([&] { touching += pair.collide().isCollision(); }));
            ASSERT_EQ(0, allocationsOf([&] { pair.collide(all); }));
            ASSERT_EQ(0, allocationsOf([&] { pair.collide(all, &contacts); }));
            ASSERT_EQ(0, allocationsOf([&] { pair.collide(several, &contacts); }));
            ASSERT_EQ(0, allocationsOf([&] { pair.collideAll(0.1, count); }));
            DistanceRequest request;
            request.enableSignedDistance = true;
            ASSERT_EQ(0, allocationsOf([&] {
                const DistanceResult first = pair.distance(request);
                request.warmStart = first.contact->nodes;
                pair.distance(request);
            }));
        });
    }
    EXPECT_GT(pairs, 1000);
    EXPECT_GT(touching, 100);
}

TEST(Allocations, OfAListAreThoseOfItsContacts)
{
    if (kSanitized) GTEST_SKIP() << "sanitizers have their own operator new";
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    CollisionRequest request;
    request.maxContacts = 20;
    std::vector<Contact> contacts;
    EXPECT_EQ(1, allocationsOf([&] { collide(tree, {}, tree, {}, request, &contacts); }));
    EXPECT_GT(contacts.size(), 1u);
    EXPECT_EQ(0, allocationsOf([&] { collide(tree, {}, tree, {}, request, &contacts); }));
}

TEST(Allocations, OfBodiesThatMoveAreNone)
{
    Random random(3);
    int met = 0;
    forEachPosePair(Exactness::Object, 300, [&](const PosePair& pair) {
        const double both = pair.a.query.radius() + pair.b.query.radius();
        const Vec3d away = 2 * both * randomDirection(random);
        const RigidTransform from = RigidTransform::fromTranslation(away) * pair.poseB;
        const RigidMotion line = RigidMotion::line(from, -1.5 * away),
                          screw = RigidMotion::screw(from, pair.poseB),
                          other = RigidMotion::screw(pair.poseA, from);
        const QueryTree &a = pair.a.query, &b = pair.b.query;
        ASSERT_EQ(0, allocationsOf([&] {
            met += continuousCollide(a, pair.poseA, b, line).isCollide;
            met += continuousCollide(a, pair.poseA, b, screw).isCollide;
            met += continuousCollide(a, other, b, screw).isCollide;
        }));
    });
    EXPECT_GT(met, 200);
}

TEST(Allocations, OfPointsAndRaysAreNone)
{
    Random random(4);
    int inside = 0, hits = 0;
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample.tree);
        const DigitalLeaves leaves(sample.tree);
        for (int i = 0; i < 100; ++i) {
            const Vec3d near = tree.leafCenter(random.between(0, tree.leafCount() - 1)),
                        point = near + 0.3 * tree.radius() * randomDirection(random);
            const Vec3d eye = tree.center() + 3 * tree.radius() * randomDirection(random);
            const QueryRay ray{eye, point - eye};
            ASSERT_EQ(0, allocationsOf([&] {
                nearest(tree, point);
                nearest(tree, point, 0.1);
                meetsBall(tree, point, 0.1);
                inside += contains(tree, leaves, point);
                hits += bool(intersect(tree, ray));
                occluded(tree, ray);
            })) << sample.name;
        }
    }
    EXPECT_GT(inside, 50);
    EXPECT_GT(hits, 500);
}

/// Loops take what their tasks take, of which there is one a thread or more; so a single thread is asked.
TEST(Allocations, OfManyQuestionsAtOnceAreNone)
{
    constexpr std::size_t kCount = 2000;
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    Random random(5);
    std::vector<QueryRay> rays;
    std::vector<RigidTransform> poses;
    std::vector<float> spheres;
    for (std::size_t i = 0; i < kCount; ++i) {
        const Vec3d direction = randomDirection(random);
        rays.push_back({tree.center() + 2 * tree.radius() * direction, -direction});
        poses.push_back(RigidTransform::fromTranslation(tree.radius() * direction));
        const Vec3d center = tree.center() + tree.radius() * direction;
        for (int axis = 0; axis < 3; ++axis) spheres.push_back(float(center[axis]));
        spheres.push_back(0.1f);
    }
    std::vector<RayHit> hits(kCount);
    std::vector<uint8_t> flags(kCount);
    std::vector<Verdict> verdicts(kCount);
    std::vector<float> distances(kCount), gradients(3 * kCount);
    std::vector<int32_t> nearestLeaves(kCount);
    const SphereDistanceArrays arrays{distances.data(), gradients.data(), nearestLeaves.data()};
    tbb::task_arena one(1);
    one.execute([&] {
        EXPECT_EQ(0, allocationsOf([&] {
            intersect(tree, rays.data(), kCount, hits.data());
            occluded(tree, rays.data(), kCount, flags.data());
        }));
        EXPECT_EQ(0, allocationsOf([&] { collideBatch(tree, tree, poses, verdicts.data()); }));
        EXPECT_EQ(0, allocationsOf([&] {
            sphereDistances(tree, spheres.data(), kCount, 1.0f, arrays);
            spheresTouch(tree, spheres.data(), kCount / 10, 10, flags.data());
        }));
    });
    EXPECT_GT(
        std::count_if(hits.begin(), hits.end(), [](const RayHit& hit) { return bool(hit); }), 300);
    EXPECT_GT(std::count_if(nearestLeaves.begin(), nearestLeaves.end(),
                  [](int32_t leaf) { return leaf >= 0; }),
        500);
}
