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

struct LeafPart {
    uint32_t leaf; ///< of the object
    LeafMask mask;
};

/// Descends into cubes that have leaves of the object and that a removed ball reaches, unless
/// another ball holds all of one.
class UncoveredVoxels {
public:
    UncoveredVoxels(const VoxelGoal& goal, const SampleLevel& object,
        const std::vector<CoverBall>& removed, std::vector<LeafPart>& found)
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
        thread_local std::vector<uint32_t> leaves;       // of the object, in the box
        thread_local std::vector<const CoverBall*> near; // of the boxes on the way down
        mFound.clear();
        leaves.clear();
        near.clear();
        if (mBox.empty()) return;
        mObject.forEachLeaf(mBox, [&](std::size_t leaf) { leaves.push_back(uint32_t(leaf)); });
        for (const CoverBall& ball : others) {
            if (!ball.empty()) near.push_back(&ball);
        }
        const Coord first = mBox.min() & ~(kLeafDim - 1);
        int64_t side = kLeafDim;
        for (int a = 0; a < 3; ++a) {
            while (int64_t(first[a]) + side <= mBox.max()[a]) side *= 2;
        }
        const int64_t origin[3] = {first[0], first[1], first[2]};
        descend(origin, side, {leaves.data(), leaves.data() + leaves.size()}, near, 0, near.size());
        std::sort(mFound.begin(), mFound.end(),
            [](const LeafPart& x, const LeafPart& y) { return x.leaf < y.leaf; });
    }

private:
    struct Leaves {
        uint32_t *begin, *end;
    };

    /// @param leaves      of the object, in a cube; they change places
    /// @param begin, end  the others near the cube, in @a near; more are put behind them
    void descend(const int64_t (&origin)[3], int64_t side, const Leaves& leaves,
        std::vector<const CoverBall*>& near, std::size_t begin, std::size_t end)
    {
        constexpr std::ptrdiff_t kFew = 8;
        if (leaves.begin == leaves.end) return;
        CoordBBox box;
        for (int a = 0; a < 3; ++a) {
            box.min()[a] = std::max(mBox.min()[a], int32_t(origin[a]));
            box.max()[a] = int32_t(std::min<int64_t>(mBox.max()[a], origin[a] + side - 1));
        }
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
        if (side <= 2 * kLeafDim || leaves.end - leaves.begin <= kFew) {
            return visit(leaves, near, end);
        }
        descendInto(origin, side / 2, leaves, near, end, last);
    }

    /// The same for the eight halves of a cube, along x, then y, then z.
    void descendInto(const int64_t (&origin)[3], int64_t half, const Leaves& leaves,
        std::vector<const CoverBall*>& near, std::size_t begin, std::size_t end, int axis = 0,
        int upper = 0)
    {
        if (axis == 3) {
            const int64_t corner[3] = {origin[0] + (upper & 1 ? half : 0),
                origin[1] + (upper & 2 ? half : 0), origin[2] + (upper & 4 ? half : 0)};
            return descend(corner, half, leaves, near, begin, end);
        }
        uint32_t* middle = std::partition(leaves.begin, leaves.end,
            [&](uint32_t leaf) { return mObject.origin(leaf)[axis] < origin[axis] + half; });
        descendInto(origin, half, {leaves.begin, middle}, near, begin, end, axis + 1, upper);
        descendInto(
            origin, half, {middle, leaves.end}, near, begin, end, axis + 1, upper | 1 << axis);
    }

    /// @return whether the ball counts wherever a removed ball does.
    bool countsLikeRemoved(const CoverBall& ball) const
    {
        return mOneGroup && ball.group == mRemoved.front().group;
    }

    static LeafMask voxelsIn(const Coord& leaf, const CoverBall& ball)
    {
        return detail::voxelsOf(ball.ball, kFineShift, leaf);
    }

    void visit(const Leaves& leaves, const std::vector<const CoverBall*>& near, std::size_t begin)
    {
        for (const uint32_t* leaf = leaves.begin; leaf != leaves.end; ++leaf) {
            const Coord& origin = mObject.origin(*leaf);
            LeafMask uncovered{};
            for (const CoverBall& ball : mRemoved) {
                if (!ball.empty())
                    uncovered |= voxelsIn(origin, ball) & mGoal.counting(*leaf, ball.group);
            }
            for (std::size_t i = begin; i < near.size() && !uncovered.none(); ++i) {
                const LeafMask held = voxelsIn(origin, *near[i]) & uncovered;
                if (held.none()) continue;
                uncovered -= countsLikeRemoved(*near[i])
                    ? held
                    : held & mGoal.counting(*leaf, near[i]->group);
            }
            if (!uncovered.none()) mFound.push_back({*leaf, uncovered});
        }
    }

    const VoxelGoal& mGoal;
    const SampleLevel& mObject;
    const std::vector<CoverBall>& mRemoved;
    std::vector<LeafPart>& mFound;
    CoordBBox mBox; ///< of the removed balls
    bool mOneGroup = true;
};

} // namespace

const LeafMask& VoxelGoal::counting(std::size_t leaf, int32_t group) const
{
    return mRegions.empty() ? mObject.mask(leaf) : maskIn(*mRegions[group], uint32_t(leaf));
}

void VoxelGoal::collectUncovered(const std::vector<CoverBall>& removed,
    const std::vector<CoverBall>& others, std::vector<Coord>& points) const
{
    thread_local std::vector<LeafPart> uncovered;
    thread_local ExtremePoints extreme;
    UncoveredVoxels(*this, mObject, removed, uncovered).list(others);
    extreme.clear();
    for (const LeafPart& part : uncovered) extreme.add(mObject.origin(part.leaf), part.mask);
    points = extreme.finish();
}

UnitGoal::UnitGoal(const std::vector<std::vector<Coord>>& units) : mUnits(units)
{
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
                return holdsAll(other.ball, mUnits[unit]);
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
