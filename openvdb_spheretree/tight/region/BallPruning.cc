// SPDX-License-Identifier: Apache-2.0
#include "BallPruning.h"

#include "BallsInBox.h"
#include "LeafDescent.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/sphere/LeafVoxels.h>
#include <openvdb_spheretree/tight/fit/BallReach.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// Voxels of a leaf that a ball is the last one to hold.
struct LastHeld {
    int32_t ball;
    LeafMask mask;
};

/// @param balls  in the order in which they are tested
/// @return for each leaf the last balls of its voxels, the last one first.
std::vector<std::vector<LastHeld>> lastHeldOf(const std::vector<ExactSphere>& balls,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<int32_t> lastFirst(balls.size());
    std::iota(lastFirst.rbegin(), lastFirst.rend(), 0);
    const BallsInBox inBox(balls);
    // Those after a ball that holds all of the box are no voxel's last. Nor are those that hold
    // nothing there which one before them does not hold.
    const auto filter = [&](const openvdb::CoordBBox& box, const std::vector<int32_t>& from,
                            std::vector<int32_t>& to) {
        StrongestBall strongest;
        inBox.list(box, from, true, strongest, to);
    };
    std::vector<std::vector<LastHeld>> lastHeld(object.leafCount());
    const auto body = [&](std::size_t leaf, const std::vector<int32_t>& near) {
        LeafMask left = object.mask(leaf);
        for (const int32_t ball : near) {
            const LeafMask mask =
                detail::voxelsOf(balls[ball], kFineShift, object.origin(leaf)) & left;
            if (mask.none()) continue;
            lastHeld[leaf].push_back({ball, mask});
            left -= mask;
            if (left.none()) break;
        }
    };
    forEachLeafWithBalls(object, std::move(lastFirst), filter, body, interrupter);
    return lastHeld;
}

} // namespace

std::vector<int32_t> prunedBalls(std::vector<ExactSphere> cover, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<int32_t> order(cover.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
        [&](int32_t a, int32_t b) { return cover[a].radiusSq < cover[b].radiusSq; });
    std::vector<ExactSphere> balls;
    balls.reserve(cover.size());
    for (const int32_t i : order) balls.push_back(cover[i]);
    std::vector<ExactSphere>().swap(cover); // there may be very many
    const auto lastHeld = lastHeldOf(balls, object, interrupter);

    struct Part {
        uint32_t leaf, i; // the i-th of lastHeld[leaf]
    };
    std::vector<std::vector<Part>> parts(balls.size());
    for (uint32_t leaf = 0; leaf < lastHeld.size(); ++leaf) {
        for (uint32_t i = 0; i < lastHeld[leaf].size(); ++i) {
            parts[lastHeld[leaf][i].ball].push_back({leaf, i});
        }
    }
    std::vector<int32_t> kept;
    std::vector<LeafMask> inKept(object.leafCount(), LeafMask{}); // voxels of balls that stay
    for (std::size_t ball = 0; ball < balls.size(); ++ball) {
        if (ball % 1024 == 0) detail::checkInterrupt(interrupter);
        const bool needed =
            std::any_of(parts[ball].begin(), parts[ball].end(), [&](const Part& part) {
                return !(lastHeld[part.leaf][part.i].mask - inKept[part.leaf]).none();
            });
        if (!needed) continue;
        kept.push_back(order[ball]);
        object.forEachLeaf(ballBox(balls[ball]), [&](std::size_t leaf) {
            const auto& last = lastHeld[leaf];
            if (last.empty() || last.front().ball <= int32_t(ball)) return; // is not read again
            if ((object.mask(leaf) - inKept[leaf]).none()) return;
            inKept[leaf] |= detail::voxelsOf(balls[ball], kFineShift, object.origin(leaf));
        });
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

} // namespace openvdb_spheretree::tight
