// SPDX-License-Identifier: Apache-2.0
#include "StrictMerging.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tight/fit/ExtremePoints.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

using openvdb::Coord;

Held joined(Held a, const Held& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

Held voxelBalls(const std::vector<Coord>& points)
{
    Held balls;
    for (const Coord& p : points) balls.push_back(voxelBall(p));
    return balls;
}

Held extremeVoxels(const Held& held)
{
    std::vector<Coord> points;
    for (const ExactSphere& voxel : held) {
        Coord& ijk = points.emplace_back();
        for (int a = 0; a < 3; ++a) ijk[a] = int32_t(voxel.center[a] / kFine);
    }
    dropInnerPoints(points);
    return voxelBalls(points);
}

/// @return the balls that reach furthest along 98 directions, which have components from -2 to 2. A
/// ball that holds these nearly holds all.
/// @param held  what this gave for each of two sets
/// @param all   how many balls both have; few are returned as they are
Held extremeBalls(const Held& held, std::size_t all)
{
    constexpr std::size_t kFew = 32;
    if (all <= kFew) return held;
    std::vector<std::size_t> chosen;
    for (int direction = 0; direction < 125; ++direction) {
        const int u[3] = {direction / 25 - 2, direction / 5 % 5 - 2, direction % 5 - 2};
        const bool even = u[0] % 2 == 0 && u[1] % 2 == 0 && u[2] % 2 == 0;
        if (even) continue; // no direction, or twice another one
        const double length = std::sqrt(double(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]));
        const auto reach = [&](const ExactSphere& ball) {
            double along = 0;
            for (int a = 0; a < 3; ++a) along += u[a] * double(ball.center[a]);
            return along / length + ball.radius();
        };
        std::size_t best = 0;
        for (std::size_t i = 1; i < held.size(); ++i) {
            if (reach(held[i]) > reach(held[best])) best = i;
        }
        chosen.push_back(best);
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    Held extreme;
    for (const std::size_t i : chosen) extreme.push_back(held[i]);
    return extreme;
}

} // namespace

StrictMerging::StrictMerging(const SampledObject& object, const std::vector<CoverBall>& leafBalls,
    HeldByLeafBalls held, const FitEffort& effort, bool flat,
    openvdb::util::NullInterrupter* interrupter)
    : mObject(object), mEffort(effort), mFlat(flat), mVoxels(held.areVoxels),
      mInterrupter(interrupter), mBalls(ballsOf(leafBalls)), mGroups(groupsOf(leafBalls)),
      mExtreme(std::move(held.held)), mCost(mBalls.size(), 0.0)
{
    if (!mVoxels) mHeld = mExtreme;
    if (held.areInside) return;
    detail::parallelFor(mBalls.size(), interrupter, [&](std::size_t i) {
        thread_local CoveringFit fit;
        fit.open(mObject, mBalls[i], mEffort.samples);
        mCost[i] = fit.costOf({mBalls[i]});
    });
}

MergeCandidate StrictMerging::evaluate(int32_t a, int32_t b) const
{
    thread_local CoveringFit fit;
    thread_local Held targets;
    targets = mExtreme[a];
    targets.insert(targets.end(), mExtreme[b].begin(), mExtreme[b].end());
    if (targets.empty()) return {-mCost[b], a, b, mBalls[a], 0}; // either would do
    fit.open(mObject, targets, {mBalls[a], mBalls[b]}, mEffort.samples);
    const FittedBall fitted = fit.best(mEffort, mFlat);
    return {fitted.cost - mCost[a] - mCost[b], a, b, fitted.ball, 0};
}

void StrictMerging::complete(MergeCandidate& merge) const
{
    if (mVoxels) return;
    for (const int32_t node : {merge.a, merge.b}) {
        for (const ExactSphere& held : mHeld[node]) {
            merge.ball.radiusSq = std::max(merge.ball.radiusSq, radiusSqToHold(merge.ball, held));
        }
    }
}

void StrictMerging::merge(const std::vector<MergeCandidate>& merges, int32_t node)
{
    mExtreme.resize(std::size_t(node) + merges.size());
    if (!mVoxels) mHeld.resize(mExtreme.size());
    detail::parallelFor(merges.size(), mInterrupter, [&](std::size_t i) {
        const MergeCandidate& c = merges[i];
        const std::size_t m = std::size_t(node) + i;
        if (mVoxels) {
            mExtreme[m] = extremeVoxels(joined(mExtreme[c.a], mExtreme[c.b]));
        } else {
            Held &some = mHeld[c.a], &others = mHeld[c.b]; // in no order
            if (some.size() < others.size()) some.swap(others);
            mHeld[m] = joined(std::move(some), others);
            // What reaches furthest of both is what does of one of them.
            mExtreme[m] = extremeBalls(joined(mExtreme[c.a], mExtreme[c.b]), mHeld[m].size());
        }
        for (const int32_t child : {c.a, c.b}) {
            Held().swap(mExtreme[child]);
            if (!mVoxels) Held().swap(mHeld[child]);
        }
    });
    for (const MergeCandidate& c : merges) {
        mBalls.push_back(c.ball);
        mCost.push_back(c.cost + mCost[c.a] + mCost[c.b]);
    }
}

HeldByLeafBalls heldVoxels(const std::vector<std::vector<Coord>>& points, bool areInside)
{
    std::vector<Held> held;
    for (const std::vector<Coord>& some : points) held.push_back(voxelBalls(some));
    return {std::move(held), true, areInside};
}

HeldByLeafBalls heldBalls(const std::vector<ExactSphere>& leafBalls, bool areInside)
{
    std::vector<Held> held;
    for (const ExactSphere& ball : leafBalls) held.push_back({ball});
    return {std::move(held), false, areInside};
}

} // namespace openvdb_spheretree::tight
