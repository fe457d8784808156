// SPDX-License-Identifier: Apache-2.0
#include "CoverGoal.h"

#include <openvdb_spheretree/sphere/LeafVoxels.h>
#include <openvdb_spheretree/tight/fit/BallReach.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tight/fit/ExtremePoints.h>

#include <algorithm>

namespace openvdb_spheretree::tight {

using openvdb::Coord;
using openvdb::CoordBBox;

namespace {

/// Descends into boxes of voxels that a removed ball reaches, unless another ball holds all of one.
class UncoveredVoxels {
public:
    UncoveredVoxels(const VoxelGoal& goal, const SampleLevel& object,
        const std::vector<CoverBall>& removed, std::vector<RegionLeaf>& found)
        : mGoal(goal), mObject(object), mRemoved(removed), mFound(found)
    {
        for (const CoverBall& ball : removed) {
            mBox.expand(ballBox(ball.ball));
            if (ball.group != removed.front().group) mOneGroup = false;
        }
    }

    /// Lists the voxels that the removed balls hold and none of the others, in the order of leaves.
    void list(const std::vector<CoverBall>& others)
    {
        mFound.clear();
        if (mBox.empty()) return;
        thread_local std::vector<const CoverBall*> near; // of the boxes on the way down
        near.clear();
        for (const CoverBall& ball : others) {
            if (!ball.empty()) near.push_back(&ball);
        }
        const std::size_t all = near.size();
        constexpr int kFirst = 128;
        const Coord first = mBox.min() & ~(kFirst - 1);
        for (int64_t x = first[0]; x <= mBox.max()[0]; x += kFirst) {
            for (int64_t y = first[1]; y <= mBox.max()[1]; y += kFirst) {
                for (int64_t z = first[2]; z <= mBox.max()[2]; z += kFirst) {
                    descend(Coord(int(x), int(y), int(z)), kFirst, near, 0, all);
                }
            }
        }
        std::sort(mFound.begin(), mFound.end(),
            [](const RegionLeaf& a, const RegionLeaf& b) { return a.leaf < b.leaf; });
    }

private:
    /// @param begin, end  the others near the box, in @a near; more are put behind them
    void descend(const Coord& origin, int side, std::vector<const CoverBall*>& near,
        std::size_t begin, std::size_t end)
    {
        const CoordBBox box = CoordBBox::createCube(origin, side);
        const bool isReached = std::any_of(mRemoved.begin(), mRemoved.end(), [&](const auto& ball) {
            return !ball.empty() && BoxReach(ball.ball, box).meets(ball.ball);
        });
        if (!isReached) return;
        near.resize(end);
        for (std::size_t i = begin; i < end; ++i) {
            const BoxReach reach(near[i]->ball, box);
            if (!reach.meets(near[i]->ball)) continue;
            if (reach.isHeldBy(near[i]->ball) && countsLikeRemoved(*near[i])) return;
            near.push_back(near[i]);
        }
        const std::size_t last = near.size();
        if (side <= 2 * kLeafDim) return visit(box, near, end);
        const int half = side / 2;
        for (int i = 0; i < 8; ++i) {
            descend(origin.offsetBy(half * (i >> 2), half * (i >> 1 & 1), half * (i & 1)), half,
                near, end, last);
        }
    }

    /// @return whether the ball counts wherever a removed ball does.
    bool countsLikeRemoved(const CoverBall& ball) const
    {
        return mOneGroup && ball.group == mRemoved.front().group;
    }

    void visit(CoordBBox box, const std::vector<const CoverBall*>& near, std::size_t begin)
    {
        box.intersect(mBox);
        if (box.empty()) return;
        mObject.forEachLeaf(box, [&](std::size_t leaf) {
            const Coord& origin = mObject.origin(leaf);
            LeafMask uncovered{};
            for (const CoverBall& ball : mRemoved) {
                if (!ball.empty() && mayReach(ball.ball, origin)) {
                    uncovered |= mGoal.heldIn(leaf, ball);
                }
            }
            for (std::size_t i = begin; i < near.size() && !uncovered.none(); ++i) {
                if (mayReach(near[i]->ball, origin)) uncovered -= mGoal.heldIn(leaf, *near[i]);
            }
            if (!uncovered.none()) mFound.push_back({uint32_t(leaf), uncovered});
        });
    }

    const VoxelGoal& mGoal;
    const SampleLevel& mObject;
    const std::vector<CoverBall>& mRemoved;
    std::vector<RegionLeaf>& mFound;
    CoordBBox mBox; ///< of the removed balls
    bool mOneGroup = true;
};

} // namespace

LeafMask VoxelGoal::heldIn(std::size_t leaf, const CoverBall& ball) const
{
    const LeafMask& counts =
        mRegions.empty() ? mObject.mask(leaf) : maskIn(*mRegions[ball.group], uint32_t(leaf));
    if (counts.none()) return counts;
    return detail::voxelsOf(ball.ball, kFineShift, mObject.origin(leaf)) & counts;
}

void VoxelGoal::collectUncovered(const std::vector<CoverBall>& removed,
    const std::vector<CoverBall>& others, std::vector<Coord>& points) const
{
    thread_local std::vector<RegionLeaf> uncovered;
    thread_local ExtremePoints extreme;
    UncoveredVoxels(*this, mObject, removed, uncovered).list(others);
    extreme.clear();
    for (const RegionLeaf& part : uncovered) extreme.add(mObject.origin(part.leaf), part.mask);
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
