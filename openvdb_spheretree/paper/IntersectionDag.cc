// SPDX-License-Identifier: Apache-2.0
#include "IntersectionDag.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/ParallelSort.h>
#include <openvdb_spheretree/index/BoundingTree.h>

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace openvdb_spheretree {

namespace {

/// |c - c'| <= r + r', all of them in the tree's units: with D = coverSq = r^2 this is
/// |c - c'|^2 - D - D' <= 2 sqrt(D D').
bool meet(const SphereTree& tree, int32_t s, int32_t t)
{
    using Wide = unsigned __int128;
    const Wide reach = Wide(tree.spheres.coverRadiusSq[s]) + Wide(tree.spheres.coverRadiusSq[t]);
    int64_t d[3];
    for (int axis = 0; axis < 3; ++axis) {
        d[axis] = int64_t(tree.subdivision * tree.spheres.center[s][axis])
            - int64_t(tree.subdivision * tree.spheres.center[t][axis]);
    }
    const Wide apart = tree.settings.dist().lengthSq(d[0], d[1], d[2]);
    if (apart <= reach) return true;
    const Wide beyond = apart - reach;
    // The right-hand side is at most D + D', so below 2^64: the square fits.
    return beyond <= reach
        && beyond * beyond
        <= 4 * Wide(tree.spheres.coverRadiusSq[s]) * tree.spheres.coverRadiusSq[t];
}

/// Around a sphere, a voxel wider than needed so that rounding is no matter. The ball of a norm
/// lies in the box of its radius, but not always in the Euclidean ball.
detail::Bound boundOf(const SphereTree& tree, int32_t id)
{
    const auto ball = detail::Bound::ofBall(tree.spheres.center[id], tree.spheres.radius[id] + 1);
    return tree.settings.dist().isEuclidean() ? ball : detail::Bound::ofBox(ball.box);
}

/// Appends the edges from the level @a above to the level @a below it.
void addEdges(const SphereTree& tree, const SphereTreeLevel& above, const SphereTreeLevel& below,
    std::vector<DagEdge>& edges, openvdb::util::NullInterrupter* interrupter)
{
    constexpr int32_t kChunk = 256;
    constexpr int64_t kMaxEdges = int64_t(1) << 28; // 2 GiB of them
    std::vector<detail::Bound> spheres;
    spheres.reserve(above.size());
    for (int32_t id = above.begin; id < above.end; ++id) spheres.push_back(boundOf(tree, id));
    const detail::BoundingTree bounds(spheres, interrupter);
    std::atomic<int64_t> found{int64_t(edges.size())};
    std::vector<std::vector<DagEdge>> ofChunk((below.size() + kChunk - 1) / kChunk);
    detail::parallelFor(ofChunk.size(), interrupter, [&](std::size_t chunk) {
        if (found > kMaxEdges) return; // reported below
        const int32_t first = below.begin + int32_t(chunk) * kChunk;
        for (int32_t s = first; s < std::min(first + kChunk, below.end); ++s) {
            if (found + int64_t(ofChunk[chunk].size()) > kMaxEdges) break;
            if (s % 16 == 0) detail::checkInterrupt(interrupter);
            bounds.visitMeeting(boundOf(tree, s), [&](int32_t place) {
                const int32_t t = above.begin + bounds.order()[place];
                if (meet(tree, s, t)) ofChunk[chunk].push_back({t, s});
            });
        }
        found += int64_t(ofChunk[chunk].size());
    });
    if (found > kMaxEdges) {
        OPENVDB_THROW(openvdb::ValueError,
            "more than 2^28 pairs of spheres of levels " << below.level << " and " << above.level
                                                         << " meet: use edges=shared, or a larger "
                                                            "voxel");
    }
    for (const auto& some : ofChunk) edges.insert(edges.end(), some.begin(), some.end());
}

} // namespace

std::vector<DagEdge> intersectionDag(
    const SphereTree& tree, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<DagEdge> edges;
    for (std::size_t k = 1; k < tree.levels.size(); ++k) {
        addEdges(tree, tree.levels[k], tree.levels[k - 1], edges, interrupter);
    }
    detail::parallelSort(edges.begin(), edges.end(), interrupter);
    return edges;
}

} // namespace openvdb_spheretree
