// SPDX-License-Identifier: Apache-2.0
#include "CoverDebt.h"

#include "BallMask.h"
#include "DebtFit.h"

#include <algorithm>

namespace openvdb_spheretree {
namespace tight {

namespace {

using openvdb::Coord;

/// Takes the voxels of a ball out of @a mask; false if none is left.
bool takeOut(const FineBall& ball, const Coord& origin, LeafMask& mask)
{
    const LeafMask held = ballMask(ball, origin);
    uint64_t any = 0;
    for (int word = 0; word < 8; ++word) {
        mask[word] &= ~held[word];
        any |= mask[word];
    }
    return any != 0;
}

/// A ball around the box of a unit.
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

void VoxelDebt::collect(const std::vector<FineBall>& lifted, const std::vector<FineBall>& others,
    std::vector<Coord>& points) const
{
    thread_local ExtremePoints extreme;
    extreme.clear();
    openvdb::CoordBBox box, one;
    for (const FineBall& ball : lifted) {
        if (ballBox(ball, one)) box.expand(one);
    }
    if (!box.empty()) {
        mObject.forEachLeaf(box, [&](std::size_t leaf) {
            const Coord& origin = mObject.origin(leaf);
            LeafMask owed{};
            for (const FineBall& ball : lifted) {
                if (ball.empty() || !mayReach(ball, origin)) continue;
                const LeafMask held = ballMask(ball, origin);
                for (int w = 0; w < 8; ++w) owed[w] |= held[w] & mObject.mask(leaf)[w];
            }
            for (const FineBall& ball : others) {
                if (!ball.empty() && mayReach(ball, origin) && !takeOut(ball, origin, owed)) return;
            }
            extreme.add(origin, owed);
        });
    }
    points = extreme.finish();
}

UnitDebt::UnitDebt(const std::vector<std::vector<Coord>>& units) : mUnits(units)
{
    for (std::size_t i = 0; i < units.size(); ++i) {
        if (!units[i].empty()) mGrid.add(int32_t(i), ballAround(units[i]));
    }
}

void UnitDebt::collect(const std::vector<FineBall>& lifted, const std::vector<FineBall>& others,
    std::vector<Coord>& points) const
{
    points.clear();
    for (std::size_t i = 0; i < lifted.size(); ++i) {
        if (lifted[i].empty()) continue;
        for (const int32_t unit : mGrid.near(lifted[i])) {
            const auto holds = [&](const FineBall& ball) { return holdsAll(ball, mUnits[unit]); };
            if (!holds(lifted[i]) || std::any_of(others.begin(), others.end(), holds)) continue;
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
