// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/fit/CoveringFit.h>

#include "support/FineBalls.h"

#include <openvdb/math/Math.h>

#include <cmath>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

constexpr FitEffort kNone{false, 0, 1, false, 40}, kMuch{true, 12, 1, true, 40};

bool holdsVoxels(const ExactSphere& ball, const Voxels& voxels)
{
    return std::all_of(
        voxels.begin(), voxels.end(), [&](const Coord& v) { return holds(ball, v); });
}

TEST(CoveringFit, NeedsTheSmallestRadiusThatHoldsABall)
{
    Random random(2);
    for (int turn = 0; turn < 4000; ++turn) {
        const int spread = 1 << random.between(1, 24);
        const ExactSphere from = randomBall(random, -spread, spread, 0);
        const ExactSphere held = randomBall(random, -spread, spread, turn % 3 ? spread : 0);
        const __int128 apart = centersApartSq(from, held);
        const int64_t needed = radiusSqToHold(from, held);
        ASSERT_TRUE(atLeastSum(needed, apart, held.radiusSq));
        ASSERT_FALSE(atLeastSum(needed - 1, apart, held.radiusSq));
    }
}

/// Where the roots are integers, nothing is rounded.
TEST(CoveringFit, NeedsTheSumOfWholeRadiiAndDistances)
{
    Random random(3);
    for (int turn = 0; turn < 1000; ++turn) {
        const int64_t far = random.between(0, 1 << random.between(0, 29));
        const int64_t radius = random.between(0, 1 << random.between(0, 29));
        ExactSphere from = randomBall(random, -9, 9, 0), held = from;
        held.center[turn % 3] += turn % 2 ? far : -far;
        held.radiusSq = radius * radius;
        from.radiusSq = turn; // which does not count
        ASSERT_EQ(radiusSqToHold(from, held), (far + radius) * (far + radius));
        held.radiusSq = 2;
        const auto root = int64_t(std::ceil(std::sqrt(8.0L * (long double)(far * far))));
        if (far < 1 << 20) {
            ASSERT_EQ(radiusSqToHold(from, held), far * far + 2 + root);
        }
    }
}

TEST(CoveringFit, CountsWhatBallsCostTogether)
{
    Random random(4);
    const Voxels voxels = shapes::noise(Coord(9, 8, 10), 0.5, random);
    const SampledObject object = sampled(voxels);
    for (int turn = 0; turn < 12; ++turn) {
        const auto replaced = randomBalls(turn % 4, random, 0, 9, 6);
        const ExactSphere other = randomBall(random, 0, 9, 6); // part of it is in the window
        CoveringFit fit;
        fit.open(object, Voxels{voxels[0]}, replaced, 40);
        ASSERT_EQ(fit.costOf({}), 0);
        ASSERT_EQ(fit.costOf(replaced), double(excess(replaced, voxels)));
        ASSERT_EQ(fit.costOf(replaced), double(excess(replaced, voxels))) << "asked again";
        fit.cover(other);
        auto both = replaced;
        both.push_back(other);
        ASSERT_EQ(fit.costOf(replaced), double(excess(both, voxels) - excess({other}, voxels)));
    }
}

/// Which stand for 8^3 voxels here.
TEST(CoveringFit, CountsWhatLargeBallsCostOnSamples)
{
    const Voxels voxels = shapes::box(Coord(3));
    const SampledObject object = sampled(voxels);
    const ExactSphere large{{7, 5, -3}, 1600 * 1600};
    const double volume = 4 / 3.0 * openvdb::math::pi<double>() * 100 * 100 * 100;
    CoveringFit fit;
    fit.open(object, voxels, {large}, 16);
    EXPECT_EQ(std::fmod(fit.costOf({large}), 512), 0);
    EXPECT_NEAR(fit.costOf({large}), volume, volume / 50);
    const Voxels apart{Coord(-100, 0, 0), Coord(100, 0, 0)};
    fit.open(object, apart, {}, 16);
    const FittedBall fitted = fit.best(kNone, false);
    EXPECT_EQ(std::fmod(fitted.cost, 512), 0);
    EXPECT_NEAR(fitted.cost, volume, volume / 50);
}

TEST(CoveringFit, HoldsAllTargetsAndCountsWhatThatCosts)
{
    Random random(5);
    for (int turn = 0; turn < 10; ++turn) {
        const Voxels voxels = shapes::noise(Coord(9, 8, 10), 0.5, random);
        const SampledObject object = sampled(voxels);
        const auto replaced = randomBalls(2, random, 0, 9, 6);
        const Voxels targets(voxels.begin(), voxels.begin() + 7 * (turn + 1) - 6);
        CoveringFit fit;
        fit.open(object, targets, replaced, 40);
        const FittedBall fitted = fit.best({true, 12, 1, turn % 2 == 0, 40}, false);
        ASSERT_TRUE(holdsVoxels(fitted.ball, targets));
        ASSERT_EQ(fitted.cost, double(excess({fitted.ball}, voxels)));
        ASSERT_LE(fitted.cost, fit.best(kNone, false).cost);
        fit.open(object, targets, {}, 40);
        const FittedBall smallest = fit.best(kNone, false), alone = fit.best(kMuch, false);
        ASSERT_EQ(alone.cost, double(excess({alone.ball}, voxels)));
        ASSERT_LE(fitted.cost, smallest.cost);
    }
}

TEST(CoveringFit, TriesTheCentersOfReplacedBallsThatHoldTheTargets)
{
    Random random(8);
    for (int turn = 0; turn < 20; ++turn) {
        const Voxels voxels = shapes::noise(Coord(9, 8, 10), 0.5, random);
        const SampledObject object = sampled(voxels);
        const Voxels targets(voxels.end() - 3, voxels.end());
        auto replaced = randomBalls(2, random, 0, 9, 1);
        for (ExactSphere& other : replaced) other.radiusSq = neededRadiusSq(other, targets);
        CoveringFit fit;
        fit.open(object, targets, replaced, 40);
        const double cost = fit.best(kNone, false).cost;
        for (const ExactSphere& other : replaced) ASSERT_LE(cost, double(excess({other}, voxels)));
    }
}

/// Wherever the samples are, and whatever floats make of them.
TEST(CoveringFit, HoldsAllTargetsExactly)
{
    Random random(6);
    for (int turn = 0; turn < 300; ++turn) {
        const int spread = 1 << random.between(1, turn % 10 ? 7 : 20);
        const Voxels voxels = translated(shapes::noise(Coord(9, 8, 10), 0.5, random), Coord(-4));
        const SampledObject object = sampled(voxels);
        const int samples = random.between(4, 16); // a radius: most balls here are larger
        const FitEffort effort{turn % 2 == 0, 3, 1, turn % 3 == 0, samples};
        Voxels targets;
        for (int n = random.between(1, 12); n > 0; --n) {
            targets.push_back(random.coord(-spread, spread));
        }
        const auto replaced = randomBalls(turn % 3, random, -spread, spread, spread);
        CoveringFit fit;
        fit.open(object, targets, replaced, samples);
        ASSERT_TRUE(holdsVoxels(fit.best(effort, false).ball, targets));
        const auto balls = randomBalls(random.between(1, 12), random, -spread, spread, spread);
        fit.open(object, balls, replaced, samples);
        const ExactSphere fitted = fit.best(effort, false).ball;
        for (const ExactSphere& ball : balls) ASSERT_TRUE(contains(fitted, ball));
    }
}

/// The plane need not be one of the sampled ones.
TEST(CoveringFit, KeepsCentersOfFlatTargetsInTheirPlane)
{
    Random random(7);
    for (int turn = 0; turn < 60; ++turn) {
        const int z = random.between(-20, 20),
                  side = turn % 3 == 0 ? 9
            : turn % 3 == 1            ? 150
                                       : 3000;
        Voxels targets;
        for (int n = random.between(1, 20); n > 0; --n) {
            targets.emplace_back(random.between(0, side), random.between(0, side), z);
        }
        sortVoxels(targets);
        const SampledObject object = sampled(targets);
        CoveringFit fit;
        fit.open(object, targets, {voxelBall(targets.front())}, 16);
        const ExactSphere fitted = fit.best({true, 12, 1, true, 16}, true).ball;
        ASSERT_EQ(fitted.center[2], 16 * z);
        ASSERT_TRUE(holdsVoxels(fitted, targets));
    }
}

/// Here the smallest ball reaches out of a round object, and one around its center does not.
TEST(CoveringFit, LooksForTheBallInTheObject)
{
    const Voxels voxels = shapes::ball(100);
    const SampledObject object = sampled(voxels);
    const Voxels targets{Coord(9, 0, 0), Coord(6, 6, 0), Coord(6, -6, 0)};
    ExactSphere other;
    other.radiusSq = neededRadiusSq(other, targets);
    CoveringFit fit;
    fit.open(object, targets, {}, 40);
    EXPECT_GT(fit.best(kNone, false).cost, 0);
    EXPECT_EQ(fit.best(kMuch, false).cost, 0);
    fit.open(object, targets, {other}, 40);
    EXPECT_EQ(fit.best(kNone, false).cost, 0);
}

} // namespace
