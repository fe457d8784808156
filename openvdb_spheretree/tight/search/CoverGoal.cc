// SPDX-License-Identifier: Apache-2.0
#include "CoverGoal.h"

#include <openvdb_spheretree/tight/fit/BallMask.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tight/fit/ExtremePoints.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree {
namespace tight {

namespace {

using openvdb::Coord;

/// @return a ball around the box of a unit.
FineBall ballAround(const std::vector<Coord>& points)
{
    openvdb::CoordBBox box;
    for (const Coord& p : points) box.expand(p);
    FineBall ball{{}, 0};
    for (int a = 0; a < 3; ++a) {
        ball.center[a] = kFine / 2 * (int64_t(box.min()[a]) + box.max()[a]);
        const int64_t half = kFine * (int64_t(box.max()[a]) - box.min()[a]) / 2 + 1;
        ball.radiusSq += half * half;
    }
    return ball;
}

} // namespace

LeafMask VoxelGoal::heldIn(std::size_t leaf, const CoverBall& ball) const
{
    const LeafMask& counts =
        mRegions.empty() ? mObject.mask(leaf) : maskIn(*mRegions[ball.group], uint32_t(leaf));
    return ballMask(ball.ball, mObject.origin(leaf)) & counts;
}

void VoxelGoal::collectUncovered(const std::vector<CoverBall>& removed,
    const std::vector<CoverBall>& others, std::vector<Coord>& points) const
{
    thread_local ExtremePoints extreme;
    extreme.clear();
    openvdb::CoordBBox box, one;
    for (const CoverBall& ball : removed) {
        if (ballBox(ball.ball, one)) box.expand(one);
    }
    if (!box.empty()) {
        mObject.forEachLeaf(box, [&](std::size_t leaf) {
            const Coord& origin = mObject.origin(leaf);
            LeafMask uncovered{};
            for (const CoverBall& ball : removed) {
                if (!ball.empty() && mayReach(ball.ball, origin)) uncovered |= heldIn(leaf, ball);
            }
            if (uncovered.none()) return;
            for (const CoverBall& ball : others) {
                if (ball.empty() || !mayReach(ball.ball, origin)) continue;
                uncovered -= heldIn(leaf, ball);
                if (uncovered.none()) return;
            }
            extreme.add(origin, uncovered);
        });
    }
    points = extreme.finish();
}

UnitGoal::UnitGoal(const std::vector<std::vector<Coord>>& units, std::vector<int32_t> groups)
    : mUnits(units), mGroups(std::move(groups))
{
    mGroups.resize(units.size(), 0);
    for (std::size_t i = 0; i < units.size(); ++i) {
        if (!units[i].empty()) mGrid.add(int32_t(i), ballAround(units[i]));
    }
}

bool UnitGoal::holds(const CoverBall& ball, int32_t unit) const
{
    return ball.group == mGroups[unit] && holdsAll(ball.ball, mUnits[unit]);
}

void UnitGoal::collectUncovered(const std::vector<CoverBall>& removed,
    const std::vector<CoverBall>& others, std::vector<Coord>& points) const
{
    points.clear();
    for (const CoverBall& ball : removed) {
        if (ball.empty()) continue;
        for (const int32_t unit : mGrid.near(ball.ball)) {
            const auto holdsUnit = [&](const CoverBall& other) { return holds(other, unit); };
            if (!holdsUnit(ball) || std::any_of(others.begin(), others.end(), holdsUnit)) continue;
            points.insert(points.end(), mUnits[unit].begin(), mUnits[unit].end());
        }
    }
    dropInnerPoints(points);
}

bool holdsAll(const FineBall& ball, const std::vector<Coord>& points)
{
    return !ball.empty() && std::all_of(points.begin(), points.end(), [&](const Coord& p) {
        return radiusSqToHold(ball, voxelBall(p)) <= ball.radiusSq;
    });
}

} // namespace tight
} // namespace openvdb_spheretree
