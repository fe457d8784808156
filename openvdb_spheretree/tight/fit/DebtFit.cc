// SPDX-License-Identifier: Apache-2.0
#include "DebtFit.h"

#include <openvdb_spheretree/base/RoundUp.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {
namespace tight {

namespace {

/// A ball of the debt may reach further than its smallest ball by this part of the radius, and this.
constexpr float kRoom = 0.35f;
constexpr float kMoreRoom = 2 * float(kFine);

/// A ball around the box of the debt: its smallest ball is no larger.
FineBall ballAroundBox(const std::vector<FineBall>& debt)
{
    FineBox box;
    for (const FineBall& held : debt) box.expand(held);
    FineBall ball{{}, 0};
    for (int a = 0; a < 3; ++a) {
        ball.center[a] = (box.lo[a] + box.hi[a]) / 2;
        const int64_t half = (box.hi[a] - box.lo[a] + 1) / 2 + 1;
        ball.radiusSq += half * half;
    }
    return ball;
}

int64_t square(int64_t x) { return x * x; }

} // namespace

int64_t radiusSqToHold(const FineBall& ball, const FineBall& held)
{
    int64_t apart = 0;
    for (int a = 0; a < 3; ++a) apart += square(ball.center[a] - held.center[a]);
    if (held.radiusSq == 0) return apart;
    // (sqrt(apart) + sqrt(radiusSq))^2, rounded up
    const auto product = 4 * (unsigned __int128)(apart) * (unsigned __int128)(held.radiusSq);
    const int64_t root = detail::integerRoot(product);
    const bool exact = (unsigned __int128)(root) * (unsigned __int128)(root) == product;
    return apart + held.radiusSq + root + (exact ? 0 : 1);
}

void DebtFit::open(const SampledObject& object, const std::vector<openvdb::Coord>& debt,
    const std::vector<FineBall>& olds, int samples)
{
    mDebt.clear();
    for (const openvdb::Coord& p : debt) {
        mDebt.push_back({{kFine * int64_t(p[0]), kFine * int64_t(p[1]), kFine * int64_t(p[2])}, 0});
    }
    mOlds = olds;
    openWindow(object, samples);
}

void DebtFit::open(const SampledObject& object, const std::vector<FineBall>& debt,
    const std::vector<FineBall>& olds, int samples)
{
    mDebt = debt;
    mOlds = olds;
    openWindow(object, samples);
}

void DebtFit::openWindow(const SampledObject& object, int samples)
{
    const FineBall around = ballAroundBox(mDebt);
    double largest = around.radius();
    mBox = FineBox();
    mBox.expand(around, double(kRoom) * around.radius() + double(kMoreRoom));
    for (const FineBall& old : mOlds) {
        mBox.expand(old);
        largest = std::max(largest, old.radius());
    }
    mWindow.reset(object, mBox, CostWindow::levelFor(largest, samples));
}

double DebtFit::costOf(const std::vector<FineBall>& balls)
{
    int64_t samples = 0;
    if (balls.size() > 1) mLeft = mWindow;
    CostWindow& left = balls.size() > 1 ? mLeft : mWindow;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        samples += left.count(left.toLocal(balls[i]));
        if (i + 1 < balls.size()) left.cover(balls[i]);
    }
    return double(samples) * double(mWindow.voxelsPerSample());
}

PaidDebt DebtFit::pay(const FitEffort& effort, bool flat)
{
    mPoints.clear();
    for (const FineBall& held : mDebt) {
        const LocalBall at = mWindow.toLocal(held);
        mPoints.add(at.x, at.y, at.z, std::sqrt(at.radiusSq));
    }
    mPoints.finish();
    mStarts.clear();
    for (const FineBall& old : mOlds) mStarts.push_back(mWindow.toLocal(old));
    const LocalBall smallest = smallestBall(mPoints, flat);
    float reach = std::sqrt(smallest.radiusSq) * (1 + kRoom);
    for (const FineBall& old : mOlds) {
        const LocalBall ball = mWindow.toLocal(old);
        const float x = ball.x - smallest.x, y = ball.y - smallest.y, z = ball.z - smallest.z;
        reach = std::max(reach, std::sqrt(x * x + y * y + z * z) + std::sqrt(ball.radiusSq));
    }
    reach += kMoreRoom;
    mCosts.collect(mWindow, {smallest.x, smallest.y, smallest.z, reach * reach});
    const BallFit fit = fitBall(mPoints, smallest, mCosts, mStarts, effort, flat);

    PaidDebt paid;
    paid.ball = mWindow.centerOf(fit.ball);
    if (flat) paid.ball.center[2] = mDebt.front().center[2]; // which need not be on a sample
    for (const FineBall& held : mDebt) {
        paid.ball.radiusSq = std::max(paid.ball.radiusSq, radiusSqToHold(paid.ball, held));
    }
    paid.cost = double(fit.cost) * double(mWindow.voxelsPerSample());
    return paid;
}

} // namespace tight
} // namespace openvdb_spheretree
