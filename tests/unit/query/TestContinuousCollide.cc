// SPDX-License-Identifier: Apache-2.0
/// @file TestContinuousCollide.cc
/// @brief Times of contact against all pairs of leaf spheres at many instants before.

#include "PosePairs.h"
#include "QuerySamples.h"
#include "support/Messages.h"
#include "support/VectorTarget.h"

#include <openvdb_spheretree/query/ContinuousCollide.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

/// Leaves grow by rounding to floats.
constexpr double kRounding = 2e-5;
constexpr double kTolerance = 1e-3;

/// A motion that may meet: from outside to a pose near contact, or anywhere to anywhere.
RigidMotion motionOf(const PosePair& pair, int i, Random& random)
{
    const double both = pair.a.query.radius() + pair.b.query.radius();
    const Vec3d direction = randomDirection(random);
    const Vec3d away = uniform(random, 0.3, 3) * both * direction;
    const RigidTransform outside = RigidTransform::fromTranslation(away) * pair.poseB;
    switch (i % 5) {
    case 0: return RigidMotion::line(outside, -uniform(random, 0.5, 1.5) * away);
    case 1: return RigidMotion::screw(outside, pair.poseB);
    case 2: { // turned about itself, too
        const Vec3d center = pair.poseB * pair.b.query.center();
        const auto turn = RigidTransform::fromTranslation(center) * randomRotation(random)
            * RigidTransform::fromTranslation(-center);
        return RigidMotion::screw(outside, turn * pair.poseB);
    }
    case 3: {
        // One after the other: arguments have no order, and samples are the same for all compilers.
        const Vec3d point = pair.poseA * pair.a.query.center() + both * randomDirection(random);
        const Vec3d axis = randomDirection(random);
        const double radians = uniform(random, -2 * M_PI, 2 * M_PI);
        return RigidMotion::screw(pair.poseB, point, axis, radians, uniform(random, -1, 1) * both);
    }
    default: { // hardly turns: the axis is far away
        const Vec3d axis = randomDirection(random);
        const auto turn =
            RigidTransform::fromRotation(axis, std::pow(10.0, uniform(random, -9, -3)));
        return RigidMotion::screw(outside, pair.poseB * turn);
    }
    }
}

double gapAt(const PosePair& pair, const RigidMotion& motion, double time)
{
    return smallestGap(leafBalls(pair.a.tree, pair.poseA), leafBalls(pair.b.tree, motion.at(time)));
}

ContinuousCollisionResult ask(
    const PosePair& pair, const RigidMotion& motion, const ContinuousCollisionRequest& request = {})
{
    return continuousCollide(pair.a.query, pair.poseA, pair.b.query, motion, request);
}

std::string refusal(const ContinuousCollisionRequest& request)
{
    const QueryTree tree = makeQueryTree(querySamples().front().tree);
    return messageOf<openvdb::ValueError>(
        [&] { continuousCollide(tree, {}, tree, RigidMotion::line({}, Vec3d(1, 0, 0)), request); });
}

} // namespace

/// More seeds than one: an error that a rounding makes is rare (about 1 in 1000 motions, when it was found).
class MotionsOf : public testing::TestWithParam<uint32_t> {};

TEST_P(MotionsOf, NothingMeetsBeforeTheTimeAndBodiesAreWithinTheToleranceThen)
{
    Random random(GetParam());
    int i = 0, met = 0, free = 0;
    forEachPosePair(Exactness::LeafUnion, 1500, [&](const PosePair& pair) {
        if (pair.a.query.leafCount() * pair.b.query.leafCount() > 4000) return;
        const RigidMotion motion = motionOf(pair, i++, random);
        ContinuousCollisionRequest request;
        request.tolerance = kTolerance;
        const ContinuousCollisionResult result = ask(pair, motion, request);
        ASSERT_TRUE(result.isDecided);
        ASSERT_EQ(result.freeUntil, result.timeOfContact);
        (result.isCollide ? met : free) += 1;
        for (int k = 0; k < 300 && result.timeOfContact > 0; ++k) {
            const double time = result.timeOfContact * k / 300;
            ASSERT_GT(gapAt(pair, motion, time), -kRounding)
                << pair.name() << i << " at " << time << " of " << result.timeOfContact;
        }
        if (!result.isCollide) return;
        const double gap = gapAt(pair, motion, result.timeOfContact);
        ASSERT_LE(gap, kTolerance + kRounding) << pair.name() << i;
        ASSERT_LE(result.contact->distance, kTolerance + kRounding);
        if (result.timeOfContact == 0) return; // met from the start: any pair that does
        ASSERT_GE(gap, -kRounding) << pair.name() << i;
        PosePair then = pair;
        then.poseB = motion.at(result.timeOfContact);
        ASSERT_NEAR(then.gapOf(result.contact->nodes), result.contact->distance, kRounding);
    });
    EXPECT_GT(met, 300);
    EXPECT_GT(free, 100);
}

INSTANTIATE_TEST_SUITE_P(ContinuousCollide, MotionsOf, testing::Range(1u, 6u));

TEST(ContinuousCollide, NoTwoCubesMeetBeforeTheTime)
{
    Random random(2);
    int i = 0, met = 0;
    forEachPosePair(Exactness::Object, 300, [&](const PosePair& pair) {
        const RigidMotion motion = motionOf(pair, i++, random);
        const ContinuousCollisionResult result = ask(pair, motion);
        met += result.isCollide;
        for (int k = 0; k < 20 && result.timeOfContact > 0; ++k) {
            PosePair then = pair;
            then.poseB = motion.at(result.timeOfContact * k / 20);
            ASSERT_FALSE(then.cubesMeet()) << pair.name() << i;
        }
    });
    EXPECT_GT(met, 100);
}

TEST(ContinuousCollide, ABodyThatMeetsAtTheStartMeetsAtTimeZero)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    const auto result = continuousCollide(tree, {}, tree, RigidMotion::line({}, Vec3d(3, 0, 0)));
    EXPECT_TRUE(result.isCollide);
    EXPECT_EQ(result.timeOfContact, 0);
}

TEST(ContinuousCollide, ABallMeetsABallWhenItShould)
{
    const QueryTree dot = makeQueryTree(querySample("one voxel").tree);
    const double r = dot.leafRadius(0);
    const auto from = RigidTransform::fromTranslation(Vec3d(10 * r, 0, 0));
    ContinuousCollisionRequest request;
    request.tolerance = 1e-9;
    const auto result =
        continuousCollide(dot, {}, dot, RigidMotion::line(from, Vec3d(-16 * r, 0, 0)), request);
    EXPECT_NEAR(result.timeOfContact, 0.5, 1e-7);
    EXPECT_LE(result.contact->distance, 1e-9);
    EXPECT_LT((result.contact->point() - dot.center() - Vec3d(r, 0, 0)).length(), 1e-6);
    request.endTime = 0.499;
    EXPECT_FALSE(
        continuousCollide(dot, {}, dot, RigidMotion::line(from, Vec3d(-16 * r, 0, 0)), request)
            .isCollide);
    // So quick that any sampling would miss it.
    const auto far = RigidTransform::fromTranslation(Vec3d(1e5 * r, 0, 0));
    const auto quick =
        continuousCollide(dot, {}, dot, RigidMotion::line(far, Vec3d(-4e5 * r, 0, 0)));
    EXPECT_NEAR(quick.timeOfContact, 0.25, 1e-5);
}

TEST(ContinuousCollide, ABodyThatStandsStillIsAskedOnce)
{
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    const auto away = RigidTransform::fromTranslation(Vec3d(2.01 * tree.radius(), 0, 0));
    EXPECT_FALSE(
        continuousCollide(tree, {}, tree, RigidMotion::line(away, Vec3d(0, 0, 0))).isCollide);
    EXPECT_TRUE(continuousCollide(tree, {}, tree, RigidMotion::line({}, Vec3d(0, 0, 0))).isCollide);
}

TEST(ContinuousCollide, ABudgetOfBlocksSaysHowFarTheWayIsFree)
{
    Random random(4);
    int i = 0, undecided = 0;
    forEachPosePair(Exactness::LeafUnion, 1000, [&](const PosePair& pair) {
        const RigidMotion motion = motionOf(pair, i++, random);
        const auto whole = ask(pair, motion);
        ContinuousCollisionRequest request;
        request.maxBlocks = 10;
        const auto result = ask(pair, motion, request);
        ASSERT_LE(result.freeUntil, whole.timeOfContact);
        ASSERT_GE(result.timeOfContact, whole.timeOfContact);
        undecided += !result.isDecided;
        if (result.isDecided) {
            ASSERT_EQ(result.timeOfContact, whole.timeOfContact);
        }
    });
    EXPECT_GT(undecided, 50);
}

TEST(ContinuousCollide, EveryVectorTargetGivesTheSameAnswersToTheLastBit)
{
    std::vector<std::vector<double>> answers;
    for (const int64_t target : allTargets()) {
        forceTarget(target);
        std::vector<double> all;
        Random random(6);
        int i = 0;
        forEachPosePair(Exactness::Object, 500, [&](const PosePair& pair) {
            const auto result = ask(pair, motionOf(pair, i++, random));
            all.insert(
                all.end(), {result.timeOfContact, double(result.isCollide), double(result.blocks)});
            if (result.contact) all.push_back(result.contact->nodes.a);
        });
        answers.push_back(all);
        EXPECT_EQ(answers.front(), answers.back()) << targetName(target);
    }
    forceTarget(0);
}

TEST(ContinuousCollide, RefusesRequestsThatMeanNothing)
{
    for (const double wrong : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        ContinuousCollisionRequest request;
        request.tolerance = wrong;
        EXPECT_TRUE(mentions(refusal(request), "the tolerance"));
    }
    for (const double wrong : {-1.0, 0.0, 1.01, std::nan("")}) {
        ContinuousCollisionRequest request;
        request.endTime = wrong;
        EXPECT_TRUE(mentions(refusal(request), "the end of a motion"));
    }
    ContinuousCollisionRequest request;
    request.maxBlocks = 0;
    EXPECT_NE(refusal(request), "");
    const QueryTree tree = makeQueryTree(querySamples().front().tree);
    const std::string message = messageOf<openvdb::ValueError>(
        [&] { continuousCollide(tree, {}, tree, RigidMotion::line({}, Vec3d(1e13, 0, 0))); });
    EXPECT_TRUE(mentions(message, "choose another unit"));
}
