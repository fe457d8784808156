// SPDX-License-Identifier: Apache-2.0
#include "LeafPruning.h"

#include "../detail/Parallel.h"
#include "BallMask.h"
#include "CoverCounts.h"
#include "LeafBalls.h"

#include <algorithm>
#include <numeric>

namespace openvdb_spheretree {
namespace tight {

namespace {

/// @return whether some voxel of the ball is in no other one.
bool isNeeded(const FineBall& ball, const SampleLevel& object, const CoverCounts& counts)
{
    openvdb::CoordBBox box;
    bool needed = false;
    if (!ballBox(ball, box)) return needed;
    object.forEachLeaf(box, [&](std::size_t leaf) {
        if (needed) return;
        const LeafMask more = counts.moreThanOnce(leaf);
        LeafMask alone; // the voxels of the leaf that only one ball holds
        uint64_t any = 0;
        for (int word = 0; word < 8; ++word) {
            alone[word] = object.mask(leaf)[word] & ~more[word];
            any |= alone[word];
        }
        if (!any || !mayReach(ball, object.origin(leaf))) return;
        const LeafMask mask = ballMask(ball, object.origin(leaf));
        for (int word = 0; word < 8; ++word) needed = needed || (mask[word] & alone[word]);
    });
    return needed;
}

void takeOut(const FineBall& ball, const SampleLevel& object, CoverCounts& counts)
{
    openvdb::CoordBBox box;
    if (!ballBox(ball, box)) return;
    object.forEachLeaf(box, [&](std::size_t leaf) {
        if (!mayReach(ball, object.origin(leaf))) return;
        counts.remove(leaf, ballMask(ball, object.origin(leaf)));
    });
}

CoverCounts countBalls(const std::vector<FineBall>& balls, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter)
{
    const LeafBalls lists(balls, object, interrupter);
    CoverCounts counts(object.leafCount(), lists.most());
    detail::parallelFor(object.leafCount(), interrupter, [&](std::size_t leaf) {
        for (const int32_t ball : lists.of(leaf)) {
            counts.add(leaf, ballMask(balls[ball], object.origin(leaf)));
        }
    });
    return counts;
}

} // namespace

std::vector<int32_t> prunedLeaves(const std::vector<MedialBall>& medial, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<FineBall> balls;
    for (const MedialBall& ball : medial) balls.push_back(fineBall(ball));
    CoverCounts counts = countBalls(balls, object, interrupter);

    std::vector<int32_t> order(balls.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
        [&](int32_t a, int32_t b) { return balls[a].radiusSq < balls[b].radiusSq; });

    // Counts only fall: a ball needed now is needed later. The rest has to be asked one by one.
    std::vector<int32_t> kept;
    std::vector<char> needed;
    constexpr std::size_t kChunk = 2048;
    for (std::size_t begin = 0; begin < order.size(); begin += kChunk) {
        const std::size_t size = std::min(kChunk, order.size() - begin);
        needed.assign(size, 0);
        detail::parallelFor(size, interrupter,
            [&](std::size_t i) { needed[i] = isNeeded(balls[order[begin + i]], object, counts); });
        for (std::size_t i = 0; i < size; ++i) {
            const int32_t id = order[begin + i];
            if (needed[i] || isNeeded(balls[id], object, counts)) {
                kept.push_back(id);
                continue;
            }
            takeOut(balls[id], object, counts);
        }
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

} // namespace tight
} // namespace openvdb_spheretree
