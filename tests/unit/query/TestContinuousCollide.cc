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

/// Of both bodies: each from somewhere near to where they are in the pair, or through there; or anywhere at all.
struct Motions {
    RigidMotion a, b;

    double gap(const PosePair& pair, double time) const
    {
        return smallestGap(leafBalls(pair.a.tree, a.at(time)), leafBalls(pair.b.tree, b.at(time)));
    }
};

Motions motionsOf(const PosePair& pair, int i, Random& random)
{
    const RigidMotion first = motionOf(pair.swapped(), i % 5, random);
    const RigidMotion second = motionOf(pair, i / 5 % 5, random);
    return {first, second};
}

ContinuousCollisionResult ask(
    const PosePair& pair, const Motions& motions, const ContinuousCollisionRequest& request = {})
{
    return continuousCollide(pair.a.query, motions.a, pair.b.query, motions.b, request);
}

ContinuousCollisionResult askSwapped(
    const PosePair& pair, const Motions& motions, const ContinuousCollisionRequest& request)
{
    return continuousCollide(pair.b.query, motions.b, pair.a.query, motions.a, request);
}

/// Holds two answers to the same question against each other. Where spheres graze each other, a rounding decides whether
/// and when they meet: so rarely that these are counted.
class SameAnswers {
public:
    void add(const ContinuousCollisionResult& one, const ContinuousCollisionResult& other)
    {
        ++mAll;
        const bool isSame = one.isCollide == other.isCollide
            && std::abs(one.timeOfContact - other.timeOfContact) <= 1e-4;
        mSame += isSame;
        mMet += one.isCollide && one.timeOfContact > 0;
    }
    ~SameAnswers()
    {
        EXPECT_GE(mSame, 0.99 * mAll) << "of " << mAll;
        EXPECT_GT(mMet, mAll / 10);
    }

private:
    int mAll = 0, mSame = 0, mMet = 0;
};

/// Calls test(pair, motions, request) with motions of both bodies, and of the second one alone.
template <typename Test>
void forEachMotion(Exactness exactness, int count, const Test& test)
{
    Random random(14);
    int i = 0;
    ContinuousCollisionRequest request;
    request.tolerance = 1e-6;
    forEachPosePair(exactness, count, [&](const PosePair& pair) {
        const Motions motions = motionsOf(pair, i++, random);
        const bool isBoth = i % 2 == 0;
        const auto still = RigidMotion::line(pair.poseA, Vec3d(0.0));
        test(pair, Motions{isBoth ? motions.a : still, motions.b}, request);
    });
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
        const double margin = request.securityMargin = i % 3 * 0.7;
        const ContinuousCollisionResult result = ask(pair, motion, request);
        ASSERT_TRUE(result.isDecided);
        ASSERT_EQ(result.freeUntil, result.timeOfContact);
        (result.isCollide ? met : free) += 1;
        for (int k = 0; k < 300 && result.timeOfContact > 0; ++k) {
            const double time = result.timeOfContact * k / 300;
            ASSERT_GT(gapAt(pair, motion, time), margin - kRounding)
                << pair.name() << i << " at " << time << " of " << result.timeOfContact;
        }
        if (!result.isCollide) return;
        const double gap = gapAt(pair, motion, result.timeOfContact);
        ASSERT_LE(gap, margin + kTolerance + kRounding) << pair.name() << i;
        ASSERT_LE(result.contact->distance, margin + kTolerance + kRounding);
        if (result.timeOfContact == 0) return; // met from the start: any pair that does
        ASSERT_GE(gap, margin - kRounding) << pair.name() << i;
        PosePair then = pair;
        then.poseB = motion.at(result.timeOfContact);
        ASSERT_NEAR(then.gapOf(result.contact->nodes), result.contact->distance, kRounding);
    });
    EXPECT_GT(met, 300);
    EXPECT_GT(free, 100);
}

TEST_P(MotionsOf, NothingMeetsBeforeTheTimeWhereBothMove)
{
    Random random(GetParam());
    int i = 0, met = 0, free = 0;
    forEachPosePair(Exactness::LeafUnion, 1000, [&](const PosePair& pair) {
        if (pair.a.query.leafCount() * pair.b.query.leafCount() > 4000) return;
        const Motions motions = motionsOf(pair, i++, random);
        ContinuousCollisionRequest request;
        request.tolerance = kTolerance;
        const double margin = request.securityMargin = i % 3 * 0.7;
        const ContinuousCollisionResult result = ask(pair, motions, request);
        ASSERT_TRUE(result.isDecided);
        ASSERT_EQ(result.freeUntil, result.timeOfContact);
        (result.isCollide ? met : free) += 1;
        for (int k = 0; k < 300 && result.timeOfContact > 0; ++k) {
            const double time = result.timeOfContact * k / 300;
            ASSERT_GT(motions.gap(pair, time), margin - kRounding)
                << pair.name() << i << " at " << time << " of " << result.timeOfContact;
        }
        if (!result.isCollide) return;
        const double gap = motions.gap(pair, result.timeOfContact);
        ASSERT_LE(gap, margin + kTolerance + kRounding) << pair.name() << i;
        ASSERT_LE(result.contact->distance, margin + kTolerance + kRounding);
        if (result.timeOfContact == 0) return;
        ASSERT_GE(gap, margin - kRounding) << pair.name() << i;
        const PosePair then = {
            pair.a, pair.b, motions.a.at(result.timeOfContact), motions.b.at(result.timeOfContact)};
        ASSERT_NEAR(then.gapOf(result.contact->nodes), result.contact->distance, kRounding);
    });
    EXPECT_GT(met, 200);
    EXPECT_GT(free, 100);
}

INSTANTIATE_TEST_SUITE_P(ContinuousCollide, MotionsOf, testing::Range(1u, 9u));

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

TEST(ContinuousCollide, NoTwoCubesMeetBeforeTheTimeWhereBothMove)
{
    Random random(3);
    int i = 0, met = 0;
    forEachPosePair(Exactness::Object, 300, [&](const PosePair& pair) {
        const Motions motions = motionsOf(pair, i++, random);
        const ContinuousCollisionResult result = ask(pair, motions);
        met += result.isCollide;
        for (int k = 0; k < 20 && result.timeOfContact > 0; ++k) {
            const double time = result.timeOfContact * k / 20;
            const PosePair then = {pair.a, pair.b, motions.a.at(time), motions.b.at(time)};
            ASSERT_FALSE(then.cubesMeet()) << pair.name() << i;
        }
    });
    EXPECT_GT(met, 70);
}

TEST(ContinuousCollide, WhereTheFirstBodyStandsStillOneThatMovesIsAsked)
{
    Random random(8);
    int i = 0, met = 0;
    forEachPosePair(Exactness::LeafUnion, 300, [&](const PosePair& pair) {
        const RigidMotion motion = motionOf(pair, i++, random);
        const auto one = ask(pair, motion);
        const auto still = ask(pair, Motions{RigidMotion::line(pair.poseA, Vec3d(0.0)), motion});
        ASSERT_EQ(still.timeOfContact, one.timeOfContact);
        ASSERT_EQ(still.blocks, one.blocks);
        // And where only the first one moves, the time is that of the same question asked the other way round.
        ContinuousCollisionRequest request;
        request.tolerance = 1e-9;
        const auto exact = ask(pair, motion, request);
        const auto turned = continuousCollide(
            pair.b.query, motion, pair.a.query, RigidMotion::line(pair.poseA, Vec3d(0.0)), request);
        ASSERT_EQ(turned.isCollide, exact.isCollide) << pair.name() << i;
        if (!exact.isCollide) return;
        ++met;
        // Where spheres graze each other a tolerance is a time that is not small.
        const double gap = gapAt(pair, motion, turned.timeOfContact);
        if (exact.timeOfContact == 0) return;
        ASSERT_NEAR(gap, 0, kRounding) << pair.name() << i;
    });
    EXPECT_GT(met, 70);
}

TEST(ContinuousCollide, SwappedBodiesMeetAtTheSameTime)
{
    SameAnswers same;
    forEachMotion(Exactness::LeafUnion, 1000,
        [&](const auto& pair, const auto& motions, const auto& request) {
            same.add(ask(pair, motions, request), askSwapped(pair, motions, request));
        });
}

TEST(ContinuousCollide, BodiesOfAMovedWorldMeetAtTheSameTime)
{
    Random random(15);
    SameAnswers same;
    forEachMotion(Exactness::LeafUnion, 1000,
        [&](const auto& pair, const auto& motions, const auto& request) {
            const auto world = RigidTransform::fromTranslation(1e6 * randomDirection(random))
                * randomRotation(random);
            const Motions moved{movedMotion(world, motions.a), movedMotion(world, motions.b)};
            same.add(ask(pair, motions, request), ask(pair, moved, request));
        });
}

TEST(ContinuousCollide, BodiesOfAxesInAnotherOrderMeetAtTheSameTime)
{
    SameAnswers same;
    TurnedPairs turned(Exactness::LeafUnion);
    forEachMotion(Exactness::LeafUnion, 1000,
        [&](const auto& pair, const auto& motions, const auto& request) {
            const Motions other{turned.of(motions.a), turned.of(motions.b)};
            same.add(ask(pair, motions, request), ask(turned.of(pair), other, request));
        });
}

/// From 10^6 to 10^9 voxels away.
TEST(ContinuousCollide, FarFromTheOriginOfTheWorldNoTwoCubesMeetBeforeTheTime)
{
    Random random(16);
    int met = 0;
    forEachMotion(
        Exactness::Object, 300, [&](const auto& pair, const auto& motions, const auto& request) {
            const double far = pair.a.tree.voxelSize() * std::pow(10.0, uniform(random, 6, 9));
            const auto world = RigidTransform::fromTranslation(far * randomDirection(random))
                * randomRotation(random);
            const Motions moved{movedMotion(world, motions.a), movedMotion(world, motions.b)};
            const auto result = ask(pair, moved, request);
            met += result.isCollide;
            for (int k = 0; k < 20 && result.timeOfContact > 0; ++k) {
                const double time = result.timeOfContact * k / 20;
                const PosePair then = {pair.a, pair.b, motions.a.at(time), motions.b.at(time)};
                // Poses there are rounded.
                ASSERT_FALSE(then.cubesMeet(2e-15 * far + 1e-9)) << pair.name() << far;
            }
        });
    EXPECT_GT(met, 60);
}

TEST(ContinuousCollide, TwoBallsThatMoveMeetWhenTheyShould)
{
    const QueryTree dot = makeQueryTree(querySample("one voxel").tree);
    const double r = dot.leafRadius(0);
    const Vec3d center = dot.center();
    const auto placed = [&](double x, double y) {
        return RigidTransform::fromTranslation(Vec3d(x * r, y * r, 0) - center);
    };
    ContinuousCollisionRequest request;
    request.tolerance = 1e-9;
    // Towards each other, each 8 of the 16 radii.
    const auto lines = continuousCollide(dot, RigidMotion::line(placed(0, 0), Vec3d(8 * r, 0, 0)),
        dot, RigidMotion::line(placed(10, 0), Vec3d(-8 * r, 0, 0)), request);
    EXPECT_NEAR(lines.timeOfContact, 0.5, 1e-7);
    EXPECT_LT((lines.contact->point() - Vec3d(5 * r, 0, 0)).length(), 1e-6);
    // On one circle of radius 10 about the origin: half a turn behind, and twice as quick.
    const auto around = [&](double x, double radians) {
        return RigidMotion::screw(placed(x, 0), Vec3d(0.0), Vec3d(0, 0, 1), radians, 0);
    };
    const double touching = 2 * std::asin(0.1); // the angle between centers two radii apart
    const auto circles = continuousCollide(dot, around(10, 6), dot, around(-10, 2), request);
    EXPECT_NEAR(circles.timeOfContact, (M_PI - touching) / 4, 1e-7);
    // As quick, and the other way round: they stay where they are to each other, however far they go.
    EXPECT_FALSE(continuousCollide(dot, around(10, 6), dot, around(-10, 6), request).isCollide);
    const auto meeting = continuousCollide(dot, around(10, 6), dot, around(-10, -6), request);
    EXPECT_NEAR(meeting.timeOfContact, (M_PI - touching) / 12, 1e-7);
    // A cycloid: one turns about its place, which leaves the line that the other goes along.
    const auto cycloid = continuousCollide(
        dot, RigidMotion::line(placed(0, -30), Vec3d(0, 60 * r, 0)), dot, around(10, 6), request);
    EXPECT_FALSE(cycloid.isCollide);
    // Whoever goes along with another one at a great speed is as near to it as at rest.
    const Vec3d quick(1e6 * r, 0, 0);
    const auto along = continuousCollide(dot, RigidMotion::line(placed(0, 0), quick), dot,
        RigidMotion::screw(placed(0, 2.01), placed(0, 2.01) * center, Vec3d(1, 0, 0), 6, quick[0]),
        request);
    EXPECT_FALSE(along.isCollide);
    const auto far = continuousCollide(dot, RigidMotion::line(placed(0, 0), quick), dot,
        RigidMotion::screw(
            placed(0, 2.01), placed(0, 2.01) * center, Vec3d(1, 0, 0), 6, 1.001 * quick[0]),
        request);
    EXPECT_FALSE(far.isCollide);
}

/// From so far off that roundings of a squared distance are larger than the balls.
TEST(ContinuousCollide, ABallThatComesFromAfarAndGrazesIsMet)
{
    const QueryTree dot = makeQueryTree(querySample("one voxel").tree);
    const double r = dot.leafRadius(0);
    Random random(5);
    const auto spin = RigidMotion::screw({}, dot.center(), Vec3d(1, 0, 0), 1, 0);
    int met = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vec3d direction = randomDirection(random);
        const Vec3d side = direction.cross(randomDirection(random)).unit();
        const double away = std::pow(10.0, uniform(random, 1, 4)),
                     depth = uniform(random, -0.2, 0.2);
        if (std::abs(depth) < 1e-5 * away) continue; // that near is contact
        const auto from =
            RigidTransform::fromTranslation(r * (away * direction + (2 - depth) * side));
        const auto line = RigidMotion::line(from, -2 * away * r * direction);
        const auto one = continuousCollide(dot, {}, dot, line);
        const auto both = continuousCollide(dot, spin, dot, line);
        ASSERT_EQ(one.isCollide, depth > 0) << away << " " << depth;
        ASSERT_EQ(both.isCollide, depth > 0) << away << " " << depth;
        met += one.isCollide;
    }
    EXPECT_GT(met, 300);
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

TEST(ContinuousCollide, AMarginOfAnySizeIsKept)
{
    const QueryTree dot = makeQueryTree(querySample("one voxel").tree);
    const double r = dot.leafRadius(0);
    for (const double margin : {1e-6, 1.0, 100.0, 1e4, 1e7, 1e10}) {
        const double start = 3 * margin + 10 * r, end = 0.5 * margin;
        const auto from = RigidTransform::fromTranslation(Vec3d(start, 0, 0));
        const auto way = RigidMotion::line(from, Vec3d(end - start, 0, 0));
        ContinuousCollisionRequest request;
        request.securityMargin = margin;
        const auto result = continuousCollide(dot, {}, dot, way, request);
        ASSERT_TRUE(result.isCollide) << margin;
        const double truth = (start - 2 * r - margin) / (start - end);
        EXPECT_NEAR(result.timeOfContact, truth, 1e-4) << margin;
        EXPECT_LE(result.timeOfContact, truth + 1e-12) << margin;
        request.endTime = 0.9 * truth;
        EXPECT_FALSE(continuousCollide(dot, {}, dot, way, request).isCollide) << margin;
    }
}

TEST(ContinuousCollide, BodiesThatStayNearerThanDoublesTellAreInContact)
{
    const QueryTree dot = makeQueryTree(querySample("one voxel").tree);
    const double r = dot.leafRadius(0);
    ContinuousCollisionRequest request;
    request.tolerance = 1e-300;
    for (const double apart : {1e-13, 1e-10}) {
        // One goes around the other.
        const auto from = RigidTransform::fromTranslation(Vec3d((2 + apart) * r, 0, 0));
        const auto around = RigidMotion::screw(from, dot.center(), Vec3d(0, 0, 1), 6, 0);
        EXPECT_EQ(continuousCollide(dot, {}, dot, around, request).isCollide, apart < 1e-12);
    }
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
        const Motions both{RigidMotion::line(pair.poseA, Vec3d(0.1, 0, 0)), motion};
        ASSERT_LE(ask(pair, both, request).freeUntil, ask(pair, both).timeOfContact);
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
            const RigidMotion motion = motionOf(pair, i, random);
            const Motions motions = motionsOf(pair, i++, random);
            for (const auto& result : {ask(pair, motion), ask(pair, motions)}) {
                all.insert(all.end(),
                    {result.timeOfContact, double(result.isCollide), double(result.blocks)});
                if (result.contact) all.push_back(result.contact->nodes.a);
            }
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
    for (const double wrong : {-1.0, std::nan(""), 1e13}) {
        ContinuousCollisionRequest request;
        request.securityMargin = wrong;
        EXPECT_TRUE(mentions(refusal(request), "the security margin"));
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
    const std::string ofBoth = messageOf<openvdb::ValueError>([&] {
        continuousCollide(tree, RigidMotion::screw({}, Vec3d(0.0), Vec3d(0, 0, 1), 1, 0), tree,
            RigidMotion::line({}, Vec3d(1e13, 0, 0)));
    });
    EXPECT_TRUE(mentions(ofBoth, "choose another unit"));
}
