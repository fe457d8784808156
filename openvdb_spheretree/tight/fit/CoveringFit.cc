// SPDX-License-Identifier: Apache-2.0
#include "CoveringFit.h"

#include <openvdb_spheretree/base/IntegerRoot.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::tight {

/// A ball may reach further from the middle of the targets than the smallest ball around them: by
/// this part of its radius, and by this much more (1/16 sample).
constexpr float kRoom = 0.35f;
constexpr float kMoreRoom = 2 * float(kFine);

int64_t radiusSqToHold(const ExactSphere& ball, const ExactSphere& held)
{
    int64_t apart = 0;
    for (int a = 0; a < 3; ++a) apart += detail::square(ball.center[a] - held.center[a]);
    if (held.radiusSq == 0) return apart;
    // (sqrt(apart) + sqrt(radiusSq))^2, rounded up. Squared lengths are below 2^61
    // (requireRoomForFineSquares() in build/ObjectLimits.cc), so 4 times the product of two is
    // below 2^124.
    const auto product = 4 * detail::Uint128(apart) * detail::Uint128(held.radiusSq);
    return apart + held.radiusSq + detail::ceilSqrtWide(product);
}

int64_t radiusSqToHold(const ExactSphere& ball, const std::vector<openvdb::Coord>& voxels)
{
    int64_t radiusSq = 0;
    for (const openvdb::Coord& voxel : voxels) {
        radiusSq = std::max(radiusSq, radiusSqToHold(ball, voxelBall(voxel)));
    }
    return radiusSq;
}

void CoveringFit::open(const SampledObject& object, const std::vector<openvdb::Coord>& targets,
    const std::vector<ExactSphere>& replaced, int samples)
{
    mTargets.clear();
    for (const openvdb::Coord& p : targets) mTargets.push_back(voxelBall(p));
    mReplaced = replaced;
    openWindow(object, samples);
}

void CoveringFit::open(const SampledObject& object, const std::vector<ExactSphere>& targets,
    const std::vector<ExactSphere>& replaced, int samples)
{
    mTargets = targets;
    mReplaced = replaced;
    openWindow(object, samples);
}

void CoveringFit::openWindow(const SampledObject& object, int samples)
{
    FineBox targets;
    for (const ExactSphere& held : mTargets) targets.expand(held);
    const ExactSphere around = ballAround(targets); // the smallest ball around them is no larger
    double largest = around.radius();
    mBox = FineBox(around, double(kRoom) * around.radius() + double(kMoreRoom));
    for (const ExactSphere& other : mReplaced) {
        mBox.expand(other);
        largest = std::max(largest, other.radius());
    }
    mWindow.reset(object, mBox, CostWindow::levelFor(largest, samples));
}

double CoveringFit::costOf(const std::vector<ExactSphere>& balls)
{
    int64_t samples = 0;
    if (balls.size() > 1) mLeft = mWindow; // a copy, from which each ball takes what it holds
    CostWindow& left = balls.size() > 1 ? mLeft : mWindow;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        samples += left.count(left.toLocal(balls[i]));
        if (i + 1 < balls.size()) left.cover(balls[i]);
    }
    return double(samples) * double(mWindow.voxelsPerSample());
}

FittedBall CoveringFit::best(const FitEffort& effort, bool flat)
{
    mPoints.clear();
    for (const ExactSphere& held : mTargets) {
        const LocalBall at = mWindow.toLocal(held);
        mPoints.add(at.x, at.y, at.z, std::sqrt(at.radiusSq));
    }
    mPoints.finish();
    mStarts.clear();
    const LocalBall smallest = smallestBall(mPoints, flat);
    float reach = std::sqrt(smallest.radiusSq) * (1 + kRoom);
    for (const ExactSphere& other : mReplaced) {
        const LocalBall& ball = mStarts.emplace_back(mWindow.toLocal(other));
        const float x = ball.x - smallest.x, y = ball.y - smallest.y, z = ball.z - smallest.z;
        reach = std::max(reach, std::sqrt(x * x + y * y + z * z) + std::sqrt(ball.radiusSq));
    }
    reach += kMoreRoom;
    mCosts.collect(mWindow, {smallest.x, smallest.y, smallest.z, reach * reach});
    const BallFit fit = fitBall(mPoints, smallest, mCosts, mStarts, effort, flat);

    FittedBall fitted;
    fitted.ball = mWindow.centerOf(fit.ball);
    if (flat) fitted.ball.center[2] = mTargets.front().center[2]; // which need not be on a sample
    for (const ExactSphere& held : mTargets) {
        fitted.ball.radiusSq = std::max(fitted.ball.radiusSq, radiusSqToHold(fitted.ball, held));
    }
    fitted.cost = double(fit.cost) * double(mWindow.voxelsPerSample());
    return fitted;
}

} // namespace openvdb_spheretree::tight
