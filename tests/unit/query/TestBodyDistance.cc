// SPDX-License-Identifier: Apache-2.0
/// @file TestBodyDistance.cc
/// @brief Distances of two bodies against all pairs of their leaf spheres, and against their voxel cubes.

#include "PosePairs.h"
#include "QuerySamples.h"
#include "support/CoreStages.h"
#include "support/Messages.h"
#include "support/VectorTarget.h"

#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/query/BodyDistance.h>

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

DistanceRequest isSigned()
{
    DistanceRequest request;
    request.enableSignedDistance = true;
    return request;
}

std::string refusal(const DistanceRequest& request)
{
    const QueryTree tree = makeQueryTree(querySamples().front().tree);
    return messageOf<openvdb::ValueError>([&] { distance(tree, {}, tree, {}, request); });
}

TEST(BodyDistance, LeavesThatReachBeyondTheTopAreNoNearerThanTheBound)
{
    Random random(77);
    int met = 0;
    for (const QuerySample& sample : querySamples()) {
        const QueryTree tree = makeQueryTree(sample, Exactness::Object);
        const QueryTree leaves = makeQueryTree(sample, Exactness::LeafUnion);
        if (tree.holdsLeaves()) continue;
        for (int i = 0; i < 300; ++i) {
            // The spheres around both are just apart.
            const RigidTransform turn = randomRotation(random);
            const Vec3d away = 2.0001 * tree.radius() * randomDirection(random);
            const auto pose =
                RigidTransform::fromTranslation(tree.center() - turn.rotate(tree.center()) + away)
                * turn;
            const DistanceResult nearest = distance(leaves, {}, leaves, pose);
            DistanceRequest request;
            request.warmStart = nearest.contact->nodes;
            const DistanceResult result = distance(tree, {}, tree, pose, request);
            ASSERT_LE(result.lowerBound, result.distance) << sample.name;
            met += nearest.distance <= 0;
        }
    }
    EXPECT_GT(met, 0);
}

} // namespace

TEST(BodyDistance, IsThatOfTheNearestPairOfLeaves)
{
    forEachPosePair(Exactness::LeafUnion, 100000, [&](const PosePair& pair) {
        const double truth = pair.smallestGap();
        const DistanceResult plain = pair.distance(), deep = pair.distance(isSigned());
        ASSERT_NEAR(plain.distance, std::max(0.0, truth), kRounding) << pair.name();
        ASSERT_NEAR(deep.distance, truth, kRounding) << pair.name();
        ASSERT_NEAR(pair.gapOf(deep.contact->nodes), truth, kRounding);
        ASSERT_EQ(deep.lowerBound, deep.distance);
        ASSERT_EQ(plain.lowerBound, plain.distance);
        if (truth > kRounding) {
            ASSERT_NEAR((plain.contact->pointA - plain.contact->pointB).length(), truth, kRounding);
        }
    });
}

TEST(BodyDistance, BoundsThatOfTheObjects)
{
    int narrow = 0;
    forEachPosePair(Exactness::Object, 3000, [&](const PosePair& pair) {
        const DistanceResult result = pair.distance();
        const double leaves = pair.smallestGap(),
                     cubes = pair.cubesMeet() ? 0 : pair.cubesDistanceAtMost();
        ASSERT_GE(result.distance, std::max(0.0, leaves) - kRounding) << pair.name();
        ASSERT_LE(result.distance, cubes + 1e-9) << pair.name();
        ASSERT_LE(result.objectsLower, cubes + 1e-9);
        ASSERT_LE(result.objectsLower, result.objectsUpper);
        // Corners and cubes: edges that pass each other are a little nearer than that.
        const double edges =
            0.5 * std::sqrt(2.0) * (pair.a.tree.voxelSize() + pair.b.tree.voxelSize());
        ASSERT_GE(result.objectsUpper, cubes - edges) << pair.name();
        narrow += result.objectsUpper < leaves + 4 * pair.a.tree.voxelSize();
    });
    EXPECT_GT(narrow, 2000);
}

/// Their spheres are no digital balls: what is known of them is how far they reach beyond the object.
TEST(BodyDistance, OfFewSpheresBoundsThatOfTheObjectsByTheirReach)
{
    TightOptions few;
    few.quality = Quality::Fast;
    few.budget.spheres = {5, 2};
    std::vector<QuerySample> samples;
    for (uint32_t seed = 1; seed < 13; ++seed) {
        QuerySample sample = querySample("few", randomObject(seed).voxels, few);
        computeLevelErrors(sample.tree, *gridOf(sample.voxels));
        const bool hasAllLeaves = std::isfinite(makeQueryTree(sample.tree).leafInset());
        if (!hasAllLeaves) samples.push_back(std::move(sample));
    }
    ASSERT_GE(samples.size(), 4u);
    std::vector<QueryBody> bodies;
    for (const QuerySample& sample : samples) {
        bodies.push_back({sample, makeQueryTree(sample.tree), sample.tree});
        ASSERT_TRUE(std::isfinite(bodies.back().query.leafReach()));
    }
    Random random(8);
    int narrow = 0;
    for (int i = 0; i < 600; ++i) {
        const std::size_t count = bodies.size(), at = std::size_t(i);
        const QueryBody &a = bodies[at % count], &b = bodies[at / count % count];
        const double apart = uniform(random, 0.5, 2) * (a.query.radius() + b.query.radius());
        const auto place =
            RigidTransform::fromTranslation(a.query.center() + apart * randomDirection(random));
        const auto toOrigin = RigidTransform::fromTranslation(-b.query.center());
        const PosePair pair{a, b, {}, place * randomRotation(random) * toOrigin};
        const DistanceResult result = pair.distance();
        const double cubes = pair.cubesMeet() ? 0 : pair.cubesDistanceAtMost();
        const double edges = std::sqrt(2.0) * a.tree.voxelSize(); // as above
        ASSERT_GE(result.objectsUpper, cubes - edges) << i;
        narrow += result.objectsUpper < cubes + 20 * a.tree.voxelSize();
    }
    EXPECT_GT(narrow, 400);
}

TEST(BodyDistance, ErrorsThatAreAllowedAreKept)
{
    int64_t blocks = 0, exact = 0;
    forEachPosePair(Exactness::LeafUnion, 5000, [&](const PosePair& pair) {
        const double truth = pair.smallestGap();
        for (const bool sign : {false, true}) {
            DistanceRequest request;
            request.enableSignedDistance = sign;
            request.relErr = 0.1;
            request.absErr = 0.05;
            const DistanceResult result = pair.distance(request);
            const double target = sign ? truth : std::max(0.0, truth);
            ASSERT_GE(result.distance, target - kRounding);
            ASSERT_LE(
                result.distance, target + std::max(0.05, std::abs(target) / 9 * 1.001) + kRounding);
            ASSERT_LE(result.lowerBound, target + kRounding);
            ASSERT_GE(result.lowerBound,
                std::min(result.distance - 0.05, 0.9 * result.distance) - kRounding);
            blocks += result.blocks;
        }
        exact += pair.distance().blocks + pair.distance(isSigned()).blocks;
    });
    EXPECT_LT(blocks, 0.95 * double(exact));
}

TEST(BodyDistance, FindsNothingBeyondTheUpperBound)
{
    forEachPosePair(Exactness::LeafUnion, 5000, [&](const PosePair& pair) {
        const double truth = pair.smallestGap();
        DistanceRequest request = isSigned();
        request.upperBound = 1.5;
        const DistanceResult result = pair.distance(request);
        if (std::abs(truth - 1.5) < kRounding) return;
        ASSERT_EQ(bool(result.contact), truth < 1.5);
        if (result.contact) {
            ASSERT_NEAR(result.distance, truth, kRounding);
        } else {
            ASSERT_EQ(result.distance, std::numeric_limits<double>::infinity());
            ASSERT_GE(result.lowerBound, 1.5 - kRounding);
            ASSERT_LE(result.lowerBound, truth + kRounding);
        }
    });
}

TEST(BodyDistance, StopsAtAPairThatIsNearEnough)
{
    int64_t blocks = 0, all = 0;
    forEachPosePair(Exactness::LeafUnion, 5000, [&](const PosePair& pair) {
        const double truth = pair.smallestGap();
        DistanceRequest request;
        request.stopBelow = 0.5;
        const DistanceResult result = pair.distance(request);
        if (truth > 0.5 + kRounding) {
            ASSERT_NEAR(result.distance, truth, kRounding);
        }
        if (truth < 0.5 - kRounding) {
            ASSERT_LE(result.distance, 0.5);
        }
        ASSERT_LE(result.lowerBound, std::max(0.0, truth) + kRounding);
        blocks += result.blocks;
        all += pair.distance().blocks;
    });
    EXPECT_LT(blocks, all);
}

TEST(BodyDistance, WithoutSignsAnyPairThatMeetsIsEnough)
{
    int64_t plain = 0, sign = 0;
    forEachPosePair(Exactness::LeafUnion, 3000, [&](const PosePair& pair) {
        if (pair.smallestGap() > -kRounding) return;
        plain += pair.distance().blocks;
        sign += pair.distance(isSigned()).blocks;
    });
    EXPECT_LT(plain, 0.8 * double(sign));
}

TEST(BodyDistance, ABudgetOfBlocksGivesBounds)
{
    int undecided = 0;
    forEachPosePair(Exactness::LeafUnion, 5000, [&](const PosePair& pair) {
        const double truth = pair.smallestGap();
        DistanceRequest request = isSigned();
        request.maxBlocks = 3;
        const DistanceResult result = pair.distance(request);
        ASSERT_LE(result.blocks, 3);
        ASSERT_GE(result.distance, truth - kRounding);
        ASSERT_LE(result.lowerBound, truth + kRounding);
        undecided += !result.isDecided;
        if (result.isDecided) {
            ASSERT_NEAR(result.distance, truth, kRounding);
        }
    });
    EXPECT_GT(undecided, 500);
}

TEST(BodyDistance, AWarmStartChangesTheWorkAlone)
{
    int64_t cold = 0, warm = 0;
    Random random(3);
    forEachPosePair(Exactness::LeafUnion, 5000, [&](const PosePair& pair) {
        const DistanceResult first = pair.distance(isSigned());
        PosePair moved = pair;
        moved.poseB = RigidTransform::fromTranslation(0.05 * randomDirection(random)) * pair.poseB;
        DistanceRequest request = isSigned();
        const DistanceResult again = moved.distance(request);
        request.warmStart = first.contact->nodes;
        const DistanceResult warmed = moved.distance(request);
        ASSERT_EQ(warmed.distance, again.distance);
        cold += again.blocks;
        warm += warmed.blocks;
    });
    EXPECT_LT(warm, 0.95 * double(cold));
    const QueryTree tree = makeQueryTree(querySamples()[0].tree);
    DistanceRequest request;
    request.warmStart = {0, 1 << 30};
    EXPECT_THROW(distance(tree, {}, tree, {}, request), openvdb::LookupError);
}

TEST(BodyDistance, SwappedBodiesAreAsFarApart)
{
    forEachPosePair(Exactness::LeafUnion, 5000, [&](const PosePair& pair) {
        ASSERT_NEAR(
            pair.distance(isSigned()).distance, pair.swapped().distance(isSigned()).distance, 1e-9);
    });
}

TEST(BodyDistance, AMovedWorldHasTheSameDistances)
{
    Random random(9);
    forEachPosePair(Exactness::LeafUnion, 3000, [&](const PosePair& pair) {
        const double far = pair.a.tree.voxelSize() * std::pow(10.0, uniform(random, 6, 9));
        const auto world =
            RigidTransform::fromTranslation(far * randomDirection(random)) * randomRotation(random);
        const DistanceResult here = pair.distance(isSigned()),
                             there = pair.movedBy(world).distance(isSigned());
        const double rounding = 1e-15 * far + 1e-9;
        ASSERT_NEAR(there.distance, here.distance, rounding) << pair.name() << far;
        const Vec3d point = world * here.contact->point();
        if (there.contact->nodes == here.contact->nodes) {
            ASSERT_LE((there.contact->point() - point).length(), 1e3 * rounding) << pair.name();
        }
    });
}

TEST(BodyDistance, FarFromTheOriginOfTheWorldObjectsAreNoNearerThanItSays)
{
    Random random(10);
    forEachPosePair(Exactness::Object, 1000, [&](const PosePair& pair) {
        const double far = pair.a.tree.voxelSize() * std::pow(10.0, uniform(random, 6, 9));
        const auto world =
            RigidTransform::fromTranslation(far * randomDirection(random)) * randomRotation(random);
        const DistanceResult result = pair.movedBy(world).distance();
        const double rounding = 1e-15 * far + 1e-9,
                     cubes = pair.cubesMeet() ? 0 : pair.cubesDistanceAtMost();
        ASSERT_LE(result.distance, cubes + rounding) << pair.name() << far;
        ASSERT_LE(result.objectsLower, cubes + rounding) << pair.name() << far;
        ASSERT_LE(result.objectsLower, result.objectsUpper) << pair.name() << far;
    });
}

TEST(BodyDistance, AxesInAnotherOrderHaveTheSameDistances)
{
    TurnedPairs turned(Exactness::LeafUnion);
    forEachPosePair(Exactness::LeafUnion, 5000, [&](const PosePair& pair) {
        ASSERT_NEAR(pair.distance(isSigned()).distance,
            turned.of(pair).distance(isSigned()).distance, kRounding);
    });
}

TEST(BodyDistance, EveryVectorTargetGivesTheSameAnswersToTheLastBit)
{
    std::vector<std::vector<double>> answers;
    for (const int64_t target : allTargets()) {
        forceTarget(target);
        std::vector<double> all;
        forEachPosePair(Exactness::Object, 2000, [&](const PosePair& pair) {
            const DistanceResult result = pair.distance(isSigned());
            all.insert(all.end(),
                {result.distance, double(result.blocks), double(result.contact->nodes.a),
                    result.contact->pointB[1]});
        });
        answers.push_back(all);
        EXPECT_EQ(answers.front(), answers.back()) << targetName(target);
    }
    forceTarget(0);
}

TEST(BodyDistance, ReachesFarAndSaysWhenItDoesNot)
{
    const QueryTree tree = makeQueryTree(querySample("one voxel").tree);
    for (const double far : {1e3, 1e8, 1e12}) {
        const auto pose = RigidTransform::fromTranslation(Vec3d(0, far, 0));
        EXPECT_NEAR(
            distance(tree, {}, tree, pose).distance, far - 2 * tree.radius(), 1e-14 * far + 1e-6);
    }
    const auto beyond = RigidTransform::fromTranslation(Vec3d(0, 1e14, 0));
    const std::string message =
        messageOf<openvdb::ValueError>([&] { distance(tree, {}, tree, beyond); });
    EXPECT_TRUE(mentions(message, "choose another unit"));
}

TEST(BodyDistance, RefusesRequestsThatMeanNothing)
{
    const double nan = std::nan("");
    for (const double wrong : {-0.1, nan, std::numeric_limits<double>::infinity()}) {
        DistanceRequest request;
        request.relErr = wrong;
        EXPECT_TRUE(mentions(refusal(request), "relErr"));
        request = {};
        request.absErr = wrong;
        EXPECT_TRUE(mentions(refusal(request), "absErr"));
    }
    DistanceRequest request;
    request.upperBound = nan;
    EXPECT_NE(refusal(request), "");
    request = {};
    request.stopBelow = nan;
    EXPECT_NE(refusal(request), "");
    request = {};
    request.maxBlocks = -5;
    EXPECT_NE(refusal(request), "");
}
