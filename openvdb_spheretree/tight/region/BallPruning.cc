// SPDX-License-Identifier: Apache-2.0
#include "BallPruning.h"

#include "LeafDescent.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/sphere/LeafVoxels.h>
#include <openvdb_spheretree/tight/fit/BallReach.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace openvdb_spheretree {
namespace tight {

namespace {

/// Voxels of a leaf that a ball is the last one to hold.
struct LastHeld {
    int32_t ball;
    LeafMask mask;
};

/// The part of a ball in a leaf: the i-th in the list of that leaf.
struct Part {
    uint32_t leaf, i;
};

/// Balls are numbered in the order in which they are tested.
class Pruning {
public:
    Pruning(std::vector<ExactSphere> balls, const SampleLevel& object,
        openvdb::util::NullInterrupter* interrupter)
        : mBalls(std::move(balls)), mObject(object), mLastHeld(object.leafCount()),
          mKeptHold(object.leafCount(), LeafMask{})
    {
        std::vector<int32_t> lastFirst(mBalls.size());
        std::iota(lastFirst.rbegin(), lastFirst.rend(), 0);
        const auto filter = [&](const openvdb::CoordBBox& box, const std::vector<int32_t>& from,
                                std::vector<int32_t>& to) { filterLast(box, from, to); };
        const auto body = [&](std::size_t leaf, const std::vector<int32_t>& lasts) {
            mLastHeld[leaf] = lastHeld(leaf, lasts);
        };
        forEachLeafWithBalls(mObject, std::move(lastFirst), filter, body, interrupter);
    }

    /// @return the balls to keep, ascending.
    std::vector<int32_t> run(openvdb::util::NullInterrupter* interrupter)
    {
        std::vector<int32_t> kept;
        const auto parts = partsOfBalls();
        for (std::size_t ball = 0; ball < parts.size(); ++ball) {
            if (ball % 1024 == 0) detail::checkInterrupt(interrupter);
            if (!isNeeded(parts[ball])) continue;
            kept.push_back(int32_t(ball));
            keep(int32_t(ball));
        }
        return kept;
    }

private:
    /// Keeps the balls up to the first that holds all of the box: those after it are no voxel's last.
    void filterLast(const openvdb::CoordBBox& box, const std::vector<int32_t>& from,
        std::vector<int32_t>& to) const
    {
        for (const int32_t ball : from) {
            const BoxReach reach(mBalls[ball], box);
            if (!reach.meets(mBalls[ball])) continue;
            to.push_back(ball);
            if (reach.isHeldBy(mBalls[ball])) return;
        }
    }

    std::vector<LastHeld> lastHeld(std::size_t leaf, const std::vector<int32_t>& lastFirst) const
    {
        std::vector<LastHeld> parts;
        LeafMask left = mObject.mask(leaf);
        for (const int32_t ball : lastFirst) {
            const LeafMask mask =
                detail::voxelsOf(mBalls[ball], kFineShift, mObject.origin(leaf)) & left;
            if (mask.none()) continue;
            parts.push_back({ball, mask});
            left -= mask;
            if (left.none()) break;
        }
        return parts;
    }

    std::vector<std::vector<Part>> partsOfBalls() const
    {
        std::vector<std::vector<Part>> parts(mBalls.size());
        for (uint32_t leaf = 0; leaf < mLastHeld.size(); ++leaf) {
            for (uint32_t i = 0; i < mLastHeld[leaf].size(); ++i) {
                parts[mLastHeld[leaf][i].ball].push_back({leaf, i});
            }
        }
        return parts;
    }

    bool isNeeded(const std::vector<Part>& parts) const
    {
        return std::any_of(parts.begin(), parts.end(), [&](const Part& part) {
            return !(mLastHeld[part.leaf][part.i].mask - mKeptHold[part.leaf]).none();
        });
    }

    void keep(int32_t ball)
    {
        openvdb::CoordBBox box;
        if (!ballBox(mBalls[ball], box)) return;
        mObject.forEachLeaf(box, [&](std::size_t leaf) {
            const auto& last = mLastHeld[leaf];
            if (last.empty() || last.front().ball <= ball) return; // is not read again
            mKeptHold[leaf] |= detail::voxelsOf(mBalls[ball], kFineShift, mObject.origin(leaf));
        });
    }

    std::vector<ExactSphere> mBalls;
    const SampleLevel& mObject;
    std::vector<std::vector<LastHeld>> mLastHeld; ///< of a leaf, the last ball first
    std::vector<LeafMask> mKeptHold;              ///< voxels in balls that stay
};

} // namespace

std::vector<int32_t> prunedBalls(const std::vector<MedialBall>& medial, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<int32_t> order(medial.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
        [&](int32_t a, int32_t b) { return medial[a].radiusSq < medial[b].radiusSq; });
    std::vector<ExactSphere> balls;
    for (const int32_t i : order) balls.push_back(fineBall(medial[i]));

    std::vector<int32_t> kept;
    for (const int32_t i : Pruning(std::move(balls), object, interrupter).run(interrupter)) {
        kept.push_back(order[i]);
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

} // namespace tight
} // namespace openvdb_spheretree
