// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/fit/BallFit.h>

#include "support/Expectations.h"
#include "support/FineBalls.h"

#include <cmath>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

Coord centerOf(const LocalBall& ball) { return Coord(int(ball.x), int(ball.y), int(ball.z)); }

/// Points of a cloud, in 1/16 of a sample, and the radii of balls around them.
struct Points {
    Voxels at;
    std::vector<int> radius;

    PointCloud cloud() const
    {
        PointCloud cloud;
        for (std::size_t i = 0; i < at.size(); ++i) {
            cloud.add(float(at[i][0]), float(at[i][1]), float(at[i][2]), float(radius[i]));
        }
        cloud.finish();
        return cloud;
    }
    /// The radius around a center that holds them all.
    double reach(const Coord& from) const
    {
        double most = 0;
        for (std::size_t i = 0; i < at.size(); ++i) {
            const double apart = std::sqrt(double(squaredDistance(at[i], from)));
            most = std::max(most, apart + radius[i]);
        }
        return most;
    }
    /// The least radius around any center in their box whose coordinates are multiples of @a step.
    double leastReach(int step) const
    {
        const CoordBBox box = boxOf(at);
        double least = 1e300;
        for (int x = box.min()[0]; x <= box.max()[0]; x += step) {
            for (int y = box.min()[1]; y <= box.max()[1]; y += step) {
                for (int z = box.min()[2]; z <= box.max()[2]; z += step) {
                    least = std::min(least, reach(Coord(x, y, z)));
                }
            }
        }
        return least;
    }
};

/// In a box of 17^3 places that are @a step apart.
Points randomPoints(int step, int radius, bool flat, Random& random)
{
    Points points;
    for (int n = random.between(1, 9); n > 0; --n) {
        Coord p = random.coord(-8, 8);
        for (int a = 0; a < 3; ++a) p[a] *= step;
        if (flat && !points.at.empty()) p[2] = points.at[0][2];
        points.at.push_back(p);
        points.radius.push_back(random.between(0, radius));
    }
    return points;
}

void expectSmallest(const Points& points, int step, bool flat)
{
    const LocalBall ball = smallestBall(points.cloud(), flat);
    const Coord center = centerOf(ball);
    ASSERT_EQ(double(ball.x), center[0]);
    ASSERT_EQ(double(ball.y), center[1]);
    ASSERT_EQ(double(ball.z), center[2]);
    if (flat) {
        ASSERT_EQ(center[2], points.at[0][2]);
    }
    const double reach = points.reach(center);
    ASSERT_NEAR(std::sqrt(double(ball.radiusSq)), reach, 1e-6 * (1 + reach));
    ASSERT_LT(reach, 1.0 + 1.015 * points.leastReach(step));
}

TEST(BallFit, FindsTheSmallestBallToAUnitAndAPercent)
{
    Random random(1);
    for (int turn = 0; turn < 240; ++turn) {
        const int step = 1 << turn % 8, radius = turn % 2 ? 5 * step : 0;
        const bool flat = turn % 3 == 0;
        ASSERT_NO_FATAL_FAILURE(
            expectSmallest(randomPoints(step, radius, flat, random), step, flat));
    }
}

TEST(BallFit, FindsTheSmallestBallOfRegularSets)
{
    const auto expectBall = [](const Voxels& at, const Coord& center, int radiusSq) {
        for (const Coord& by : {Coord(0, 0, 0), Coord(-500, 33, 1000)}) {
            const Points points{translated(at, by), std::vector<int>(at.size(), 0)};
            const LocalBall ball = smallestBall(points.cloud());
            EXPECT_EQ(centerOf(ball), center + by);
            EXPECT_EQ(ball.radiusSq, float(radiusSq));
        }
    };
    expectBall({Coord(7, -3, 5)}, Coord(7, -3, 5), 0);
    expectBall({Coord(1, 2, 3), Coord(61, 82, 43)}, Coord(31, 42, 23), 900 + 1600 + 400);
    expectBall({Coord(0, 0, 0), Coord(0, 64, 0), Coord(20, 30, 5)}, Coord(0, 32, 0), 1024);
    Voxels cube;
    for (int i = 0; i < 8; ++i) cube.emplace_back(i & 1 ? 96 : 0, i & 2 ? 96 : 0, i & 4 ? 96 : 0);
    expectBall(cube, Coord(48, 48, 48), 3 * 48 * 48);
}

/// An object, some voxels to be held, and what costs around them.
struct Problem {
    SampledObject object;
    CostWindow window;
    PointCloud points;
    LocalBall smallest;
    CostRuns costs;
    std::vector<LocalBall> starts;

    Problem(const Voxels& voxels, const Voxels& targets, bool flat, float room, Random& random)
        : object(sampled(voxels))
    {
        FineBox box;
        for (const Coord& v : voxels) box.expand(voxelBall(v), 200);
        window.reset(object, box, 0);
        for (const Coord& v : targets) {
            const LocalBall at = window.toLocal(voxelBall(v));
            points.add(at.x, at.y, at.z);
        }
        points.finish();
        smallest = smallestBall(points, flat);
        const float reach = std::sqrt(smallest.radiusSq) * room + 32 * (room - 1);
        costs.collect(window, {smallest.x, smallest.y, smallest.z, reach * reach});
        for (int i = random.between(0, 3); i > 0; --i) {
            const Coord by = random.coord(-40, 40);
            starts.push_back({smallest.x + float(by[0]), smallest.y + float(by[1]),
                flat ? smallest.z : smallest.z + float(by[2]), -1});
        }
    }
    LocalBall around(const LocalBall& at) const
    {
        return {at.x, at.y, at.z, points.farthest(at.x, at.y, at.z).distanceSq};
    }
    bool isBetter(const LocalBall& ball, const BallFit& than) const
    {
        const int64_t cost = window.count(ball);
        return cost < than.cost || (cost == than.cost && ball.radiusSq < than.ball.radiusSq);
    }
    BallFit fit(const FitEffort& effort, bool flat) const
    {
        return fitBall(points, smallest, costs, starts, effort, flat);
    }
    /// It holds the points, no start is better, and it costs what it says.
    void expectFair(const BallFit& fit) const
    {
        ASSERT_TRUE(costs.fits(fit.ball));
        ASSERT_EQ(fit.ball.radiusSq, around(fit.ball).radiusSq);
        ASSERT_EQ(fit.cost, window.count(fit.ball));
        ASSERT_FALSE(isBetter(smallest, fit));
        for (const LocalBall& start : starts) {
            ASSERT_FALSE(costs.fits(around(start)) && isBetter(around(start), fit));
        }
    }
    /// Nor is any ball a step away.
    void expectBottom(const BallFit& fit, bool flat) const
    {
        for (const Coord& step : voxelsOfBox(CoordBBox(Coord(-1), Coord(1)))) {
            if (fit.cost == 0 || (flat && step[2] != 0)) continue;
            LocalBall ball = fit.ball;
            ball.x += float(step[0]);
            ball.y += float(step[1]);
            ball.z += float(step[2]);
            ASSERT_FALSE(costs.fits(around(ball)) && isBetter(around(ball), fit)) << step;
        }
    }
};

Problem randomProblem(bool flat, float room, Random& random)
{
    Voxels voxels = shapes::noise(Coord(11, 10, flat ? 1 : 9), 0.6, random), targets;
    voxels.emplace_back(5, 5, 0);
    sortVoxels(voxels);
    for (int n = random.between(1, 12); n > 0; --n) {
        targets.push_back(voxels[std::size_t(random.between(0, int(voxels.size()) - 1))]);
    }
    return Problem(voxels, targets, flat, room, random);
}

TEST(BallFit, HoldsItsPointsAndEndsWhereNoStepCostsLess)
{
    Random random(2);
    int better = 0;
    for (int turn = 0; turn < 120; ++turn) {
        const bool flat = turn % 3 == 0;
        const Problem problem = randomProblem(flat, 1.4f, random);
        const BallFit best = problem.fit({true, 1000, 1, turn % 2 == 0, 40}, flat);
        ASSERT_NO_FATAL_FAILURE(problem.expectFair(best)) << turn;
        ASSERT_NO_FATAL_FAILURE(problem.expectBottom(best, flat)) << turn;
        if (flat) {
            ASSERT_EQ(best.ball.z, problem.smallest.z);
        }
        better += best.cost < problem.window.count(problem.smallest);
    }
    EXPECT_GE(better, expectedFigure("ball_fit.better_than_smallest_ball"));
}

TEST(BallFit, WithoutEffortIsTheBestStart)
{
    Random random(3);
    for (int turn = 0; turn < 60; ++turn) {
        const bool flat = turn % 3 == 0;
        const Problem problem = randomProblem(flat, 1.4f, random);
        const BallFit best = problem.fit({true, 0, 1, turn % 2 == 0, 40}, flat);
        ASSERT_NO_FATAL_FAILURE(problem.expectFair(best)) << turn;
        bool isStart = best.ball.radiusSq == problem.smallest.radiusSq;
        for (const LocalBall& start : problem.starts) {
            isStart = isStart || centerOf(start) == centerOf(best.ball);
        }
        ASSERT_TRUE(isStart);
        const BallFit coarse = problem.fit({true, 9, 16, turn % 2 == 0, 40}, flat);
        ASSERT_NO_FATAL_FAILURE(problem.expectFair(coarse)) << turn;
        ASSERT_LE(coarse.cost, best.cost);
    }
}

TEST(BallFit, TriesNoBallThatReachesOutOfThePlace)
{
    Random random(4);
    for (int turn = 0; turn < 20; ++turn) {
        const Problem problem = randomProblem(false, 0.9f, random);
        if (problem.smallest.radiusSq == 0) continue;
        const BallFit none = problem.fit({true, 12, 1, turn % 2 == 0, 40}, false);
        ASSERT_TRUE(none.cost == INT64_MAX || problem.costs.fits(none.ball));
        ASSERT_EQ(none.cost == INT64_MAX, none.ball.radiusSq < 0);
    }
}

} // namespace
