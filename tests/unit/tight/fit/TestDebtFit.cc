// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/fit/DebtFit.h>

#include "support/FineBalls.h"

#include <cmath>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

constexpr FitEffort kNone{false, 0, 1, false, 40}, kMuch{true, 12, 1, true, 40};

bool holdsVoxels(const FineBall& ball, const Voxels& voxels)
{
    return std::all_of(
        voxels.begin(), voxels.end(), [&](const Coord& v) { return holds(ball, v); });
}

TEST(DebtFit, NeedsTheSmallestRadiusThatHoldsABall)
{
    Random random(2);
    for (int turn = 0; turn < 4000; ++turn) {
        const int spread = 1 << random.between(1, 24);
        const FineBall from = randomBall(random, -spread, spread, 0);
        const FineBall held = randomBall(random, -spread, spread, turn % 3 ? spread : 0);
        const __int128 apart = centersApartSq(from, held);
        const int64_t needed = radiusSqToHold(from, held);
        ASSERT_TRUE(atLeastSum(needed, apart, held.radiusSq));
        ASSERT_FALSE(atLeastSum(needed - 1, apart, held.radiusSq));
    }
}

/// Where the roots are integers, nothing is rounded.
TEST(DebtFit, NeedsTheSumOfWholeRadiiAndDistances)
{
    Random random(3);
    for (int turn = 0; turn < 1000; ++turn) {
        const int64_t far = random.between(0, 1 << random.between(0, 29));
        const int64_t radius = random.between(0, 1 << random.between(0, 29));
        FineBall from = randomBall(random, -9, 9, 0), held = from;
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

TEST(DebtFit, CountsWhatBallsCostTogether)
{
    Random random(4);
    const Voxels voxels = shapes::noise(Coord(9, 8, 10), 0.5, random);
    const SampledObject object = sampled(voxels);
    for (int turn = 0; turn < 12; ++turn) {
        const auto olds = randomBalls(turn % 4, random, 0, 9, 6);
        const FineBall other = randomBall(random, 0, 9, 6); // part of it is in the window
        DebtFit fit;
        fit.open(object, Voxels{voxels[0]}, olds, 40);
        ASSERT_EQ(fit.costOf({}), 0);
        ASSERT_EQ(fit.costOf(olds), double(excess(olds, voxels)));
        ASSERT_EQ(fit.costOf(olds), double(excess(olds, voxels))) << "asked again";
        fit.cover(other);
        auto both = olds;
        both.push_back(other);
        ASSERT_EQ(fit.costOf(olds), double(excess(both, voxels) - excess({other}, voxels)));
    }
}

/// Which stand for 8^3 voxels here.
TEST(DebtFit, CountsWhatLargeBallsCostOnSamples)
{
    const Voxels voxels = shapes::box(Coord(3));
    const SampledObject object = sampled(voxels);
    const FineBall large{{7, 5, -3}, 1600 * 1600};
    const double volume = 4 / 3.0 * M_PI * 100 * 100 * 100;
    DebtFit fit;
    fit.open(object, voxels, {large}, 16);
    EXPECT_EQ(std::fmod(fit.costOf({large}), 512), 0);
    EXPECT_NEAR(fit.costOf({large}), volume, volume / 50);
    const Voxels apart{Coord(-100, 0, 0), Coord(100, 0, 0)};
    fit.open(object, apart, {}, 16);
    const PaidDebt paid = fit.pay(kNone, false);
    EXPECT_EQ(std::fmod(paid.cost, 512), 0);
    EXPECT_NEAR(paid.cost, volume, volume / 50);
}

TEST(DebtFit, PaysWhatIsOwedAndCountsWhatThatCosts)
{
    Random random(5);
    for (int turn = 0; turn < 10; ++turn) {
        const Voxels voxels = shapes::noise(Coord(9, 8, 10), 0.5, random);
        const SampledObject object = sampled(voxels);
        const auto olds = randomBalls(2, random, 0, 9, 6);
        const Voxels debt(voxels.begin(), voxels.begin() + 7 * (turn + 1) - 6);
        DebtFit fit;
        fit.open(object, debt, olds, 40);
        const PaidDebt paid = fit.pay({true, 12, 1, turn % 2 == 0, 40}, false);
        ASSERT_TRUE(holdsVoxels(paid.ball, debt));
        ASSERT_EQ(paid.cost, double(excess({paid.ball}, voxels)));
        ASSERT_LE(paid.cost, fit.pay(kNone, false).cost);
        fit.open(object, debt, {}, 40);
        const PaidDebt smallest = fit.pay(kNone, false), alone = fit.pay(kMuch, false);
        ASSERT_EQ(alone.cost, double(excess({alone.ball}, voxels)));
        ASSERT_LE(paid.cost, smallest.cost);
    }
}

TEST(DebtFit, TriesTheCentersOfOldBallsThatHoldTheDebt)
{
    Random random(8);
    for (int turn = 0; turn < 20; ++turn) {
        const Voxels voxels = shapes::noise(Coord(9, 8, 10), 0.5, random);
        const SampledObject object = sampled(voxels);
        const Voxels debt(voxels.end() - 3, voxels.end());
        auto olds = randomBalls(2, random, 0, 9, 1);
        for (FineBall& old : olds) old.radiusSq = neededRadiusSq(old, debt);
        DebtFit fit;
        fit.open(object, debt, olds, 40);
        const double cost = fit.pay(kNone, false).cost;
        for (const FineBall& old : olds) ASSERT_LE(cost, double(excess({old}, voxels)));
    }
}

/// Wherever the samples are, and whatever floats make of them.
TEST(DebtFit, HoldsTheWholeDebtExactly)
{
    Random random(6);
    for (int turn = 0; turn < 300; ++turn) {
        const int spread = 1 << random.between(1, turn % 10 ? 7 : 20);
        const Voxels voxels = translated(shapes::noise(Coord(9, 8, 10), 0.5, random), Coord(-4));
        const SampledObject object = sampled(voxels);
        const int samples = random.between(4, 16); // a radius: most balls here are larger
        const FitEffort effort{turn % 2 == 0, 3, 1, turn % 3 == 0, samples};
        Voxels debt;
        for (int n = random.between(1, 12); n > 0; --n) {
            debt.push_back(random.coord(-spread, spread));
        }
        const auto olds = randomBalls(turn % 3, random, -spread, spread, spread);
        DebtFit fit;
        fit.open(object, debt, olds, samples);
        ASSERT_TRUE(holdsVoxels(fit.pay(effort, false).ball, debt));
        const auto balls = randomBalls(random.between(1, 12), random, -spread, spread, spread);
        fit.open(object, balls, olds, samples);
        const FineBall paid = fit.pay(effort, false).ball;
        for (const FineBall& ball : balls) ASSERT_TRUE(contains(paid, ball));
    }
}

/// The plane need not be one of the sampled ones.
TEST(DebtFit, KeepsCentersOfFlatDebtsInTheirPlane)
{
    Random random(7);
    for (int turn = 0; turn < 60; ++turn) {
        const int z = random.between(-20, 20),
                  side = turn % 3 == 0 ? 9
            : turn % 3 == 1            ? 150
                                       : 3000;
        Voxels debt;
        for (int n = random.between(1, 20); n > 0; --n) {
            debt.emplace_back(random.between(0, side), random.between(0, side), z);
        }
        sortVoxels(debt);
        const SampledObject object = sampled(debt);
        DebtFit fit;
        fit.open(object, debt, {voxelBall(debt.front())}, 16);
        const FineBall paid = fit.pay({true, 12, 1, true, 16}, true).ball;
        ASSERT_EQ(paid.center[2], 16 * z);
        ASSERT_TRUE(holdsVoxels(paid, debt));
    }
}

/// Here the smallest ball reaches out of a round object, and one around its centre does not.
TEST(DebtFit, LooksForTheBallInTheObject)
{
    const Voxels voxels = shapes::ball(100);
    const SampledObject object = sampled(voxels);
    const Voxels debt{Coord(9, 0, 0), Coord(6, 6, 0), Coord(6, -6, 0)};
    FineBall old;
    old.radiusSq = neededRadiusSq(old, debt);
    DebtFit fit;
    fit.open(object, debt, {}, 40);
    EXPECT_GT(fit.pay(kNone, false).cost, 0);
    EXPECT_EQ(fit.pay(kMuch, false).cost, 0);
    fit.open(object, debt, {old}, 40);
    EXPECT_EQ(fit.pay(kNone, false).cost, 0);
}

} // namespace
