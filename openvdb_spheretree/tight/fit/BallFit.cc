// SPDX-License-Identifier: Apache-2.0
#include "BallFit.h"

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::tight {

namespace {

struct Step {
    int x, y, z;
};

constexpr Step kAxes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
constexpr Step kDiagonals[20] = {{1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, 0, 1},
    {1, 0, -1}, {-1, 0, 1}, {-1, 0, -1}, {0, 1, 1}, {0, 1, -1}, {0, -1, 1}, {0, -1, -1}, {1, 1, 1},
    {1, 1, -1}, {1, -1, 1}, {1, -1, -1}, {-1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {-1, -1, -1}};

/// @return the ball around the center of another one that holds the points.
LocalBall ballAround(const PointCloud& points, const LocalBall& at)
{
    return {at.x, at.y, at.z, points.farthestSq(at.x, at.y, at.z)};
}

/// The same after a step of the center.
LocalBall ballAfter(const PointCloud& points, const LocalBall& from, const Step& step, int size)
{
    const auto s = float(size);
    return ballAround(points,
        {from.x + s * float(step.x), from.y + s * float(step.y), from.z + s * float(step.z)});
}

/// One descent, with the best ball so far.
class Descent {
public:
    Descent(const PointCloud& points, const CostRuns& costs, bool flat)
        : mPoints(points), mCosts(costs), mFlat(flat)
    {}

    bool attempt(const LocalBall& ball)
    {
        if (containsBest(ball) || !mCosts.fits(ball)) return false;
        const BallFit fit{ball, mCosts.count(ball, mBest.cost)};
        if (!fit.isBetterThan(mBest)) return false;
        mBest = fit;
        return true;
    }

    void run(const FitEffort& effort)
    {
        if (mBest.ball.radiusSq < 0) return;
        const float quarter = std::sqrt(mBest.ball.radiusSq) / 4;
        int size = 1;
        while (2 * size <= int(quarter)) size *= 2;
        for (; size >= effort.smallest && mBest.cost > 0; size /= 2) {
            for (int round = 0; round < effort.stepsPerSize && mBest.cost > 0; ++round) {
                if (!tryAll(kAxes, size, false)
                    && !(effort.diagonals && tryAll(kDiagonals, size, true))) {
                    break;
                }
            }
        }
    }

    const BallFit& best() const { return mBest; }

private:
    /// Such a ball costs no less than the best one.
    bool containsBest(const LocalBall& ball) const
    {
        const LocalBall& best = mBest.ball;
        if (best.radiusSq < 0 || ball.radiusSq < best.radiusSq) return false;
        const float slack = std::sqrt(ball.radiusSq) - std::sqrt(best.radiusSq);
        const float x = ball.x - best.x, y = ball.y - best.y, z = ball.z - best.z;
        return x * x + y * y + z * z <= slack * slack;
    }

    template <std::size_t N>
    bool tryAll(const Step (&steps)[N], int size, bool firstOnly)
    {
        bool any = false;
        for (const Step& step : steps) {
            if (mFlat && step.z != 0) continue;
            if (!attempt(ballAfter(mPoints, mBest.ball, step, size))) continue;
            any = true;
            if (firstOnly) return true;
        }
        return any;
    }

    const PointCloud& mPoints;
    const CostRuns& mCosts;
    bool mFlat;
    BallFit mBest;
};

} // namespace

LocalBall smallestBall(const PointCloud& points, bool flat)
{
    float center[3];
    for (int a = 0; a < 3; ++a) {
        float lo = points.coordinate(a, 0), hi = lo;
        for (std::size_t i = 1; i < points.size(); ++i) {
            lo = std::min(lo, points.coordinate(a, i));
            hi = std::max(hi, points.coordinate(a, i));
        }
        center[a] = (lo + hi) / 2;
    }
    // Badoiu and Clarkson, "Smaller core-sets for balls" (2003): towards the farthest point, by
    // less and less.
    constexpr int kRounds = 30;
    for (int round = 1; round <= kRounds; ++round) {
        const auto far = points.farthest(center[0], center[1], center[2]);
        const float part = round < 8 ? 0.12f : 1.0f / float(round + 1);
        for (int a = 0; a < 3; ++a) {
            center[a] += part * (points.coordinate(a, far.point) - center[a]);
        }
    }
    const float z = flat ? points.coordinate(2, 0) : std::rint(center[2]);
    LocalBall best = ballAround(points, {std::rint(center[0]), std::rint(center[1]), z});
    for (int size = 16; size > 0; size /= 2) {
        for (bool moved = true; moved;) {
            moved = false;
            for (const Step& step : kAxes) {
                if (flat && step.z != 0) continue;
                const LocalBall ball = ballAfter(points, best, step, size);
                if (!(ball.radiusSq < best.radiusSq)) continue;
                best = ball;
                moved = true;
            }
        }
    }
    return best;
}

BallFit fitBall(const PointCloud& points, const LocalBall& smallest, const CostRuns& costs,
    const std::vector<LocalBall>& starts, const FitEffort& effort, bool flat)
{
    Descent first(points, costs, flat);
    first.attempt(ballAround(points, smallest));
    if (!effort.restarts) {
        for (const LocalBall& start : starts) first.attempt(ballAround(points, start));
    }
    first.run(effort);
    BallFit best = first.best();
    if (!effort.restarts) return best;
    for (const LocalBall& start : starts) {
        Descent again(points, costs, flat);
        again.attempt(ballAround(points, start));
        again.run(effort);
        if (again.best().isBetterThan(best)) best = again.best();
    }
    return best;
}

} // namespace openvdb_spheretree::tight
