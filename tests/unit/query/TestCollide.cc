// SPDX-License-Identifier: Apache-2.0
/// @file TestCollide.cc
/// @brief Verdicts and contacts of two bodies against all pairs of their leaf spheres; that nothing that meets is
/// missed, in any rounding; the same answers for threads and vectors. Of worlds elsewhere: TestCollideWorlds.cc.

#include "ObjectReference.h"
#include "PosePairs.h"
#include "QuerySamples.h"
#include "support/Messages.h"
#include "support/VectorTarget.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/query/Collide.h>
#include <openvdb_spheretree/query/QueryData.h>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

/// Leaves grow by rounding to floats: gaps this near to 0 may be either.
constexpr double kRounding = 2e-5;

/// All pairs of leaves that are within a margin, by node id, and those that are nearly.
struct NaivePairs {
    std::set<std::pair<int32_t, int32_t>> certain, possible;

    NaivePairs(const PosePair& pair, double margin)
    {
        const auto a = leafBalls(pair.a.tree, pair.poseA), b = leafBalls(pair.b.tree, pair.poseB);
        const int32_t firstA = pair.a.tree.levels[0].begin, firstB = pair.b.tree.levels[0].begin;
        for (std::size_t i = 0; i < a.size(); ++i) {
            for (std::size_t j = 0; j < b.size(); ++j) {
                const double apart = gap(a[i], b[j]) - margin;
                const std::pair<int32_t, int32_t> ids(firstA + int32_t(i), firstB + int32_t(j));
                if (apart <= -kRounding) certain.insert(ids);
                if (apart <= kRounding) possible.insert(ids);
            }
        }
    }
};

/// Of spheres as questions see them, in more digits than doubles have.
long double exactSmallestGap(
    const QueryTree& tree, const RigidTransform& poseA, const RigidTransform& poseB)
{
    const auto coordinate = [&](const RigidTransform& pose, int32_t leaf, int axis) {
        const detail::FloatSphere s = tree.data().spheres.leaf(leaf);
        const Vec3d& origin = tree.data().origin;
        const long double p[3] = {(long double)origin[0] + s.x, (long double)origin[1] + s.y,
            (long double)origin[2] + s.z};
        long double sum = pose.translation()[axis];
        for (int j = 0; j < 3; ++j) sum += p[j] * pose.rotation()(axis, j);
        return sum;
    };
    long double smallest = std::numeric_limits<long double>::infinity();
    for (int32_t a = 0; a < tree.leafCount(); ++a) {
        for (int32_t b = 0; b < tree.leafCount(); ++b) {
            long double sum = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const long double d = coordinate(poseA, a, axis) - coordinate(poseB, b, axis);
                sum += d * d;
            }
            const long double radii =
                (long double)tree.data().spheres.leaf(a).r + tree.data().spheres.leaf(b).r;
            smallest = std::min(smallest, std::sqrt(sum) - radii);
        }
    }
    return smallest;
}

/// All turns that map axes to axes.
std::vector<openvdb::Mat3d> turnsOfAxes()
{
    std::vector<openvdb::Mat3d> turns;
    for (int order = 0; order < 6; ++order) {
        const int x = order / 2, y = (x + 1 + order % 2) % 3, z = 3 - x - y;
        for (int signs = 0; signs < 8; ++signs) {
            openvdb::Mat3d turn = openvdb::Mat3d::zero();
            turn(0, x) = signs & 1 ? -1 : 1;
            turn(1, y) = signs & 2 ? -1 : 1;
            turn(2, z) = signs & 4 ? -1 : 1;
            if (turn.det() > 0) turns.push_back(turn);
        }
    }
    return turns;
}

std::string refusal(const CollisionRequest& request)
{
    const QueryTree tree = makeQueryTree(querySamples().front().tree);
    return messageOf<openvdb::ValueError>([&] { collide(tree, {}, tree, {}, request); });
}

} // namespace

TEST(Collide, AgreesWithAllPairsOfLeavesWhereTreesHoldThem)
{
    int touching = 0, apart = 0, nearTruth = 0;
    forEachPosePair(Exactness::LeafUnion, 100000, [&](const PosePair& pair) {
        CollisionRequest request;
        request.enableDistanceLowerBound = request.enableContact = true;
        const CollisionResult result = pair.collide(request);
        const double truth = pair.smallestGap();
        ASSERT_NE(result.verdict, Verdict::Undecided);
        if (std::abs(truth) > kRounding) {
            ASSERT_EQ(result.isCollision(), truth < 0) << pair.name() << truth;
        }
        if (result.isCollision()) {
            ++touching;
            ASSERT_TRUE(result.contact);
            ASSERT_LE(result.contact->distance, kRounding);
            ASSERT_NEAR(result.contact->distance, pair.gapOf(result.nodes), kRounding);
        } else {
            ++apart;
            ASSERT_LE(result.distanceLowerBound, truth);
            nearTruth += result.distanceLowerBound > 0.5 * truth;
            ASSERT_FALSE(result.contact);
        }
    });
    EXPECT_GT(touching, 20000);
    EXPECT_GT(apart, 20000);
    EXPECT_GT(nearTruth, apart / 2) << "a lower bound of 0 would be true, and of no use";
}

TEST(Collide, NoTwoVoxelCubesMeetThatAreSaidToBeApart)
{
    int met = 0, apart = 0;
    forEachPosePair(Exactness::Object, 20000, [&](const PosePair& pair) {
        CollisionRequest request;
        request.decideObjects = true;
        const CollisionResult result = pair.collide(request);
        if (result.verdict == Verdict::Apart) {
            ++apart;
            ASSERT_FALSE(pair.cubesMeet()) << pair.name();
            ASSERT_EQ(result.objects, Verdict::Apart);
            return;
        }
        ASSERT_LE(pair.gapOf(result.nodes), kRounding);
        ASSERT_NE(result.objects, Verdict::Apart);
        if (result.objects != Verdict::Touching) return;
        ++met;
        ASSERT_TRUE(pair.cubesMeet()) << pair.name();
    });
    EXPECT_GT(met, 500);
    EXPECT_GT(apart, 4000);
}

/// Every place near contact in steps of a hair less than a quarter voxel, so that faces, edges and corners that would touch
/// overlap by a hair; in every turn of the axes, alone and with one more turn.
void expectNoneApartThatMeet(const QuerySample& sampleA, const QuerySample& sampleB)
{
    const QueryBody a{sampleA, makeQueryTree(sampleA.tree, Exactness::Object), sampleA.tree};
    const QueryBody b{sampleB, makeQueryTree(sampleB.tree, Exactness::Object), sampleB.tree};
    const double quarter = 0.2499 * a.tree.voxelSize();
    const Vec3d first = a.tree.transform->indexToWorld(Vec3d(0.0));
    const auto toOrigin =
        RigidTransform::fromTranslation(-b.tree.transform->indexToWorld(Vec3d(0.0)));
    constexpr int kReach = 12; // quarters
    int met = 0, apart = 0;
    for (const RigidTransform& more :
        {RigidTransform(), RigidTransform::fromRotation(Vec3d(1, 2, 3), 0.7)}) {
        for (const openvdb::Mat3d& turn : turnsOfAxes()) {
            const RigidTransform turned = more * RigidTransform(turn, Vec3d(0.0)) * toOrigin;
            for (const Coord& at : openvdb::CoordBBox(Coord(-kReach), Coord(kReach))) {
                const auto place = RigidTransform::fromTranslation(first + quarter * at.asVec3d());
                const PosePair pair{a, b, {}, place * turned};
                const bool isApart = pair.collide().verdict == Verdict::Apart;
                ASSERT_FALSE(isApart && pair.cubesMeet()) << at << turn;
                (isApart ? apart : met) += 1;
            }
        }
    }
    EXPECT_GT(met, 50000);
    EXPECT_GT(apart, 50000);
}

TEST(Collide, NoTwoCubesOfSmallObjectsThatMeetAreApartInAnyPlaceNearContact)
{
    TightOptions fast;
    fast.quality = Quality::Fast;
    const QuerySample dot = querySample("a dot", {Coord(0)}, fast);
    const QuerySample corner =
        querySample("a corner", {Coord(0), Coord(1, 0, 0), Coord(0, 1, 0)}, fast);
    expectNoneApartThatMeet(dot, dot);
    expectNoneApartThatMeet(dot, corner);
}

/// More leaves than a block has lanes: chains go through blocks below blocks.
TEST(Collide, NoCubeThatMeetsOneOfManyLeavesIsApart)
{
    TightOptions fast;
    fast.quality = Quality::Fast;
    const QuerySample dot = querySample("a dot", {Coord(0)}, fast);
    Voxels checkers;
    for (const Coord& at : openvdb::CoordBBox(Coord(-1), Coord(1))) {
        if ((at[0] + at[1] + at[2]) % 2 != 0) checkers.push_back(at);
    }
    const QuerySample many = querySample("checkers", checkers, fast);
    const SphereTreeLevel& leaves = many.tree.levels.front();
    ASSERT_GT(leaves.end - leaves.begin, 8);
    ASSERT_GT(many.tree.levels.size(), 1u);
    expectNoneApartThatMeet(many, dot);
}

TEST(Collide, SpheresInsideAreCertainOfTouchingAlone)
{
    for (const bool strict : {false, true}) {
        InnerOptions options;
        options.strict = strict;
        const QuerySample sample = querySample("inner", shapes::ball(20), options);
        const QueryBody body{sample, makeQueryTree(sample.tree), sample.tree};
        EXPECT_FALSE(body.query.holdsObject());
        Random random(6);
        CollisionRequest request;
        request.decideObjects = true;
        int touching = 0, apart = 0;
        for (int i = 0; i < 400; ++i) {
            const auto pose = RigidTransform::fromTranslation(
                uniform(random, 0, 1.2) * 2 * body.query.radius() * randomDirection(random));
            const PosePair pair{body, body, {}, pose};
            const CollisionResult result = pair.collide(request);
            ASSERT_NE(result.objects, Verdict::Apart);
            apart += result.verdict == Verdict::Apart;
            if (result.objects != Verdict::Touching) continue;
            ++touching;
            ASSERT_TRUE(pair.cubesMeet());
        }
        EXPECT_GT(touching, 30);
        EXPECT_GT(apart, 30);
    }
}

TEST(Collide, FindsTheDeepestPairsInTheirOrder)
{
    forEachPosePair(Exactness::LeafUnion, 3000, [&](const PosePair& pair) {
        CollisionRequest request;
        request.maxContacts = 5;
        std::vector<Contact> contacts(17);
        const CollisionResult result = pair.collide(request, &contacts);
        std::vector<double> gaps = pair.allGaps();
        std::sort(gaps.begin(), gaps.end());
        for (std::size_t i = 0; i < contacts.size(); ++i) {
            ASSERT_NEAR(contacts[i].distance, gaps[i], kRounding);
            ASSERT_NEAR(contacts[i].distance, pair.gapOf(contacts[i].nodes), kRounding);
        }
        ASSERT_LE(contacts.size(), 5u);
        if (contacts.size() < std::min<std::size_t>(5, gaps.size())) {
            ASSERT_GT(gaps[contacts.size()], -kRounding);
        }
        ASSERT_EQ(result.isCollision(), !contacts.empty());
        std::set<std::pair<int32_t, int32_t>> different;
        for (const Contact& c : contacts) different.insert({c.nodes.a, c.nodes.b});
        ASSERT_EQ(different.size(), contacts.size());
    });
}

TEST(Collide, TheSearchForTheDeepestPairsBoundsTheDistanceToo)
{
    int apart = 0, nearTruth = 0;
    forEachPosePair(Exactness::LeafUnion, 5000, [&](const PosePair& pair) {
        std::vector<Contact> contacts;
        CollisionRequest request;
        request.maxContacts = 5;
        request.securityMargin = 0.3;
        const double truth = pair.smallestGap();
        const CollisionResult plain = pair.collide(request, &contacts);
        request.enableDistanceLowerBound = true;
        const CollisionResult bound = pair.collide(request, &contacts);
        ASSERT_EQ(plain.verdict, bound.verdict);
        if (bound.verdict != Verdict::Apart) {
            ASSERT_EQ(bound.distanceLowerBound, 0) << pair.name();
            return;
        }
        ++apart;
        ASSERT_LE(plain.distanceLowerBound, truth) << pair.name();
        ASSERT_GE(plain.distanceLowerBound, 0.3 - kRounding) << pair.name();
        ASSERT_LE(bound.distanceLowerBound, truth) << pair.name();
        ASSERT_GE(bound.distanceLowerBound, plain.distanceLowerBound) << pair.name();
        nearTruth += bound.distanceLowerBound > 0.3 + 0.5 * (truth - 0.3);
    });
    EXPECT_GT(apart, 1000);
    EXPECT_GT(nearTruth, apart / 3);
}

TEST(Collide, AllContactsAreThoseOfAllPairs)
{
    const auto& samples = querySamples();
    const auto most = std::max_element(
        samples.begin(), samples.end(), [](const QuerySample& a, const QuerySample& b) {
            return a.tree.level(0).size() < b.tree.level(0).size();
        });
    const QueryTree tree = makeQueryTree(most->tree, Exactness::LeafUnion);
    CollisionRequest request;
    request.maxContacts = std::numeric_limits<int>::max();
    request.securityMargin = tree.radius();
    std::vector<Contact> contacts;
    collide(tree, {}, tree, {}, request, &contacts);
    std::size_t pairs = 0;
    collideAll(tree, {}, tree, {}, request.securityMargin, [&](const NodePair*, int count) {
        pairs += std::size_t(count);
        return true;
    });
    EXPECT_GT(pairs, 64u); // more than one search finds
    EXPECT_EQ(contacts.size(), pairs);
    EXPECT_TRUE(std::is_sorted(contacts.begin(), contacts.end(),
        [](const Contact& a, const Contact& b) { return a.distance < b.distance; }));
    request.maxContacts = 70;
    const double deepest = contacts.front().distance, last = contacts[69].distance;
    collide(tree, {}, tree, {}, request, &contacts);
    ASSERT_EQ(contacts.size(), 70u);
    EXPECT_EQ(contacts.front().distance, deepest);
    EXPECT_EQ(contacts.back().distance, last);
}

TEST(Collide, CallsBackForEveryPairOnce)
{
    forEachPosePair(Exactness::LeafUnion, 2000, [&](const PosePair& pair) {
        for (const double margin : {0.0, 0.4}) {
            const NaivePairs naive(pair, margin);
            std::set<std::pair<int32_t, int32_t>> found;
            const CollisionResult result =
                pair.collideAll(margin, [&](const NodePair* pairs, int count) {
                    for (int i = 0; i < count; ++i)
                        EXPECT_TRUE(found.insert({pairs[i].a, pairs[i].b}).second);
                    return true;
                });
            ASSERT_TRUE(std::includes(
                found.begin(), found.end(), naive.certain.begin(), naive.certain.end()));
            ASSERT_TRUE(std::includes(
                naive.possible.begin(), naive.possible.end(), found.begin(), found.end()));
            ASSERT_EQ(result.isCollision(), !found.empty());
        }
    });
}

TEST(Collide, StopsWhenTheCallbackHasHadEnough)
{
    const auto& sample = std::max_element(
        querySamples().begin(), querySamples().end(), [](const auto& a, const auto& b) {
            return a.tree.levels[0].size() < b.tree.levels[0].size();
        });
    const QueryTree tree = makeQueryTree(sample->tree);
    int all = 0, calls = 0;
    collideAll(
        tree, {}, tree, {}, 2 * tree.radius(), [&](const NodePair*, int) { return ++all > 0; });
    ASSERT_GT(all, 3);
    collideAll(
        tree, {}, tree, {}, 2 * tree.radius(), [&](const NodePair*, int) { return ++calls < 3; });
    EXPECT_EQ(calls, 3);
}

TEST(Collide, AMarginIsADistance)
{
    forEachPosePair(Exactness::LeafUnion, 3000, [&](const PosePair& pair) {
        const double truth = pair.smallestGap();
        for (const double margin : {0.1, 1.0, 30.0}) {
            if (std::abs(truth - margin) < kRounding) continue;
            CollisionRequest request;
            request.securityMargin = margin;
            ASSERT_EQ(pair.collide(request).isCollision(), truth < margin);
        }
    });
}

TEST(Collide, IsRightToTheLastBitsOfPosesAndSpheres)
{
    // A leaf of each body is moved so that they touch, or not, by far less than floats can tell.
    const QueryTree tree = makeQueryTree(querySample("two far voxels").tree);
    ASSERT_GE(tree.leafCount(), 2);
    const Vec3d center = tree.leafCenter(0);
    const double radius = tree.leafRadius(0);
    Random random(5);
    int touching = 0, apart = 0;
    for (int i = 0; i < 40000; ++i) {
        const double far = std::pow(10.0, uniform(random, -3, 7));
        const RigidTransform world =
            RigidTransform::fromTranslation(far * randomDirection(random)) * randomRotation(random);
        const RigidTransform turn = randomRotation(random);
        const double noise = uniform(random, -1, 1) * (1e-13 + 1e-14 * far);
        const Vec3d offset = (2 * radius + noise) * randomDirection(random);
        const RigidTransform other =
            world * RigidTransform::fromTranslation(center + offset - turn.rotate(center)) * turn;
        const long double truth = exactSmallestGap(tree, world, other);
        int pairs = 0;
        const auto all = collideAll(tree, world, tree, other, 0,
            [&](const NodePair*, int count) { return (pairs += count) > 0; });
        const Verdict verdict = collide(tree, world, tree, other).verdict;
        ASSERT_EQ(all.verdict, verdict);
        if (truth <= 0) {
            ++touching;
            ASSERT_EQ(verdict, Verdict::Touching) << double(truth) << " at " << far;
        } else if (truth > 1e-12 + 2e-14 * far) {
            ASSERT_EQ(verdict, Verdict::Apart) << double(truth) << " at " << far;
        }
        // Too little for floats, and more than doubles are off by.
        const RigidTransform further = RigidTransform::fromTranslation((1e-9 + 1e-13 * far)
                                           * world.rotate(offset / offset.length()))
            * other;
        if (exactSmallestGap(tree, world, further) < 1e-12 + 2e-14 * far) continue;
        ++apart;
        ASSERT_EQ(collide(tree, world, tree, further).verdict, Verdict::Apart) << far;
    }
    EXPECT_GT(touching, 10000);
    EXPECT_GT(apart, 30000);
}

TEST(Collide, ABodyInAnotherTouchesIt)
{
    const QueryTree ball =
        makeQueryTree(querySample("ball", shapes::ball(150), TightOptions()).tree);
    const QueryTree& dot = makeQueryTree(querySample("one voxel").tree);
    const RigidTransform inside = RigidTransform::fromTranslation(ball.center() - dot.center());
    EXPECT_EQ(collide(ball, {}, dot, inside).verdict, Verdict::Touching);
    CollisionRequest request;
    request.decideObjects = true;
    EXPECT_EQ(collide(ball, {}, dot, inside, request).objects, Verdict::Touching);
}

TEST(Collide, ABatchIsTheSameForAnyNumberOfThreadsAndAsOneByOne)
{
    const QueryTree a = makeQueryTree(querySamples()[0].tree),
                    b = makeQueryTree(querySamples()[4].tree);
    Random random(4);
    std::vector<RigidTransform> poses;
    for (int i = 0; i < 3000; ++i) {
        poses.push_back(RigidTransform::fromTranslation(a.center() - b.center()
                            + uniform(random, 0, 1) * randomDirection(random))
            * randomRotation(random));
    }
    std::vector<Verdict> one(poses.size()), many(poses.size());
    tbb::task_arena(1).execute([&] { collideBatch(a, b, poses, one.data()); });
    tbb::task_arena(2).execute([&] { collideBatch(a, b, poses, many.data()); });
    EXPECT_EQ(one, many);
    for (std::size_t i = 0; i < poses.size(); ++i)
        EXPECT_EQ(one[i], collide(a, {}, b, poses[i]).verdict);
    CollisionRequest objects;
    objects.decideObjects = true;
    collideBatch(a, b, poses, many.data(), objects);
    for (std::size_t i = 0; i < poses.size(); ++i)
        EXPECT_EQ(many[i], collide(a, {}, b, poses[i], objects).objects);
    EXPECT_NE(one, many) << "spheres touch where objects need not";
    EXPECT_GT(std::count(one.begin(), one.end(), Verdict::Touching), 20);
    EXPECT_GT(std::count(one.begin(), one.end(), Verdict::Apart), 100);
}

TEST(Collide, ABatchCanBeInterrupted)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    std::vector<Verdict> verdicts(100);
    EXPECT_THROW(
        collideBatch(tree, tree, std::vector<RigidTransform>(100), verdicts.data(), {}, &stop),
        Interrupted);
}

TEST(Collide, EveryVectorTargetGivesTheSameAnswersToTheLastBit)
{
    std::vector<std::vector<double>> answers;
    for (const int64_t target : allTargets()) {
        forceTarget(target);
        std::vector<double> all;
        forEachPosePair(Exactness::Object, 2000, [&](const PosePair& pair) {
            CollisionRequest request;
            request.enableDistanceLowerBound = request.enableContact = true;
            const CollisionResult result = pair.collide(request);
            all.insert(all.end(),
                {double(result.verdict), double(result.blocks), result.distanceLowerBound});
            if (result.contact)
                all.insert(all.end(), {double(result.contact->nodes.a), result.contact->distance});
            pair.collideAll(0.1, [&](const NodePair* pairs, int count) {
                for (int i = 0; i < count; ++i) all.push_back(pairs[i].a * 1000.0 + pairs[i].b);
                return true;
            });
        });
        answers.push_back(all);
        EXPECT_EQ(answers.front(), answers.back()) << targetName(target);
    }
    forceTarget(0);
}

TEST(Collide, ABudgetOfBlocksDecidesOrSaysThatItDoesNot)
{
    int undecided = 0, unfinished = 0;
    forEachPosePair(Exactness::LeafUnion, 3000, [&](const PosePair& pair) {
        const CollisionResult whole = pair.collide();
        ASSERT_TRUE(whole.isDecided);
        CollisionRequest request;
        request.maxBlocks = 2;
        const CollisionResult result = pair.collide(request);
        ASSERT_LE(result.blocks, 2);
        ASSERT_EQ(result.isDecided, result.verdict != Verdict::Undecided);
        request.maxContacts = 3;
        std::vector<Contact> few, deepest;
        const CollisionResult several = pair.collide(request, &few);
        request.maxBlocks = -1;
        ASSERT_TRUE(pair.collide(request, &deepest).isDecided);
        if (several.isDecided) {
            ASSERT_EQ(few.size(), deepest.size());
            for (std::size_t i = 0; i < few.size(); ++i)
                ASSERT_EQ(few[i].distance, deepest[i].distance);
        }
        unfinished += !several.isDecided && !few.empty();
        if (result.verdict == Verdict::Undecided) {
            ++undecided;
        } else {
            ASSERT_EQ(result.verdict, whole.verdict);
        }
    });
    EXPECT_GT(undecided, 100);
    EXPECT_GT(unfinished, 0);
}

TEST(Collide, AWarmStartIsLookedAtFirst)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    CollisionRequest request;
    request.warmStart = {tree.nodeId(0), tree.nodeId(0)};
    const CollisionResult result = collide(tree, {}, tree, {}, request);
    EXPECT_EQ(result.blocks, 0);
    EXPECT_TRUE(result.nodes == request.warmStart);
    const auto away =
        RigidTransform::fromTranslation(Vec3d(0.9 * tree.leafRadius(0) + 2 * tree.radius(), 0, 0));
    EXPECT_EQ(collide(tree, {}, tree, away, request).verdict, Verdict::Apart);
    for (const NodePair wrong :
        {NodePair{0, tree.nodeId(tree.leafCount())}, {tree.nodeId(0), -1}}) {
        request.warmStart = wrong;
        EXPECT_THROW(collide(tree, {}, tree, {}, request), openvdb::LookupError);
        const auto far = RigidTransform::fromTranslation(Vec3d(1e6, 0, 0));
        EXPECT_THROW(collide(tree, {}, tree, far, request), openvdb::LookupError);
    }
}

TEST(Collide, ContactsAreWhereTheSpheresMeet)
{
    const QueryTree dot = makeQueryTree(querySample("one voxel").tree);
    const double r = dot.leafRadius(0);
    const auto moved = RigidTransform::fromTranslation(Vec3d(0, 1.5 * r, 0));
    CollisionRequest request;
    request.enableContact = true;
    const Contact contact = *collide(dot, {}, dot, moved, request).contact;
    EXPECT_NEAR(contact.distance, -0.5 * r, 1e-6);
    EXPECT_LT((contact.normal - Vec3d(0, 1, 0)).length(), 1e-6);
    EXPECT_LT((contact.pointA - dot.center() - Vec3d(0, r, 0)).length(), 1e-6);
    EXPECT_LT((contact.pointB - dot.center() - Vec3d(0, 0.5 * r, 0)).length(), 1e-6);
    EXPECT_LT((contact.point() - dot.center() - Vec3d(0, 0.75 * r, 0)).length(), 1e-6);
    EXPECT_TRUE(
        collide(dot, {}, dot, {}, request).contact->normal.eq(Vec3d(1, 0, 0))); // concentric
}

TEST(Collide, RefusesRequestsThatMeanNothing)
{
    CollisionRequest request;
    request.securityMargin = -0.1;
    EXPECT_NE(refusal(request).find("the security margin is -0.1"), std::string::npos);
    request.securityMargin = std::nan("");
    EXPECT_NE(refusal(request), "");
    request.securityMargin = std::numeric_limits<double>::infinity();
    EXPECT_NE(refusal(request), "");
    request = {};
    request.maxContacts = 0;
    EXPECT_NE(refusal(request).find("0 contacts"), std::string::npos);
    request = {};
    request.maxBlocks = 0;
    EXPECT_NE(refusal(request).find("maxBlocks 0"), std::string::npos);
    request.maxBlocks = -2;
    EXPECT_NE(refusal(request), "");
}

TEST(Collide, BodiesAsFarApartAsDoublesGoAreApart)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    const auto far = RigidTransform::fromTranslation(Vec3d(1e150, 0, 0));
    EXPECT_EQ(collide(tree, {}, tree, far).verdict, Verdict::Apart);
    CollisionRequest request;
    request.securityMargin = 1e200;
    EXPECT_THROW(collide(tree, {}, tree, far, request), openvdb::ValueError);
}
