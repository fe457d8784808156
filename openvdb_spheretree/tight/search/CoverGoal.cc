// SPDX-License-Identifier: Apache-2.0
#include "CoverGoal.h"

#include <openvdb_spheretree/sphere/LeafVoxels.h>
#include <openvdb_spheretree/tight/fit/BallReach.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tight/fit/ExtremePoints.h>

#include <algorithm>

namespace openvdb_spheretree::tight {

using openvdb::Coord;

LeafMask VoxelGoal::heldIn(std::size_t leaf, const CoverBall& ball) const
{
    const LeafMask& counts =
        mRegions.empty() ? mObject.mask(leaf) : maskIn(*mRegions[ball.group], uint32_t(leaf));
    return detail::voxelsOf(ball.ball, kFineShift, mObject.origin(leaf)) & counts;
}

void VoxelGoal::collectUncovered(const std::vector<CoverBall>& removed,
    const std::vector<CoverBall>& others, std::vector<Coord>& points) const
{
    thread_local ExtremePoints extreme;
    extreme.clear();
    openvdb::CoordBBox box;
    for (const CoverBall& ball : removed) box.expand(ballBox(ball.ball));
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
    points = extreme.finish();
}

UnitGoal::UnitGoal(const std::vector<std::vector<Coord>>& units, std::vector<int32_t> groups)
    : mUnits(units), mGroups(std::move(groups))
{
    mGroups.resize(units.size(), 0);
    for (std::size_t i = 0; i < units.size(); ++i) {
        FineBox box;
        for (const Coord& p : units[i]) box.expand(voxelBall(p));
        if (!units[i].empty()) mGrid.add(int32_t(i), ballAround(box));
    }
}

void UnitGoal::collectUncovered(const std::vector<CoverBall>& removed,
    const std::vector<CoverBall>& others, std::vector<Coord>& points) const
{
    points.clear();
    for (const CoverBall& ball : removed) {
        if (ball.empty()) continue;
        for (const int32_t unit : mGrid.near(ball.ball)) {
            const auto holds = [&](const CoverBall& other) {
                return other.group == mGroups[unit] && holdsAll(other.ball, mUnits[unit]);
            };
            if (!holds(ball) || std::any_of(others.begin(), others.end(), holds)) continue;
            points.insert(points.end(), mUnits[unit].begin(), mUnits[unit].end());
        }
    }
    dropInnerPoints(points);
}

bool holdsAll(const ExactSphere& ball, const std::vector<Coord>& points)
{
    return !ball.empty() && std::all_of(points.begin(), points.end(), [&](const Coord& p) {
        return radiusSqToHold(ball, voxelBall(p)) <= ball.radiusSq;
    });
}

} // namespace openvdb_spheretree::tight
