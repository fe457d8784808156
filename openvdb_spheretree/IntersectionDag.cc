// SPDX-License-Identifier: Apache-2.0
#include "IntersectionDag.h"

#include "detail/Parallel.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <numeric>

namespace openvdb_spheretree {

namespace {

using openvdb::Vec3d;

/// |c - c'| <= r + r', all of them doubled: with D = coverSq = (2r)^2 this is
/// |2c - 2c'|^2 - D - D' <= 2 sqrt(D D').
bool meet(const SphereTree& tree, int32_t s, int32_t t)
{
    using Wide = unsigned __int128;
    const Wide reach = Wide(tree.coverSq[s]) + Wide(tree.coverSq[t]);
    int64_t d[3];
    for (int axis = 0; axis < 3; ++axis) {
        d[axis] = int64_t(2 * tree.center[s][axis]) - int64_t(2 * tree.center[t][axis]);
    }
    const Wide apart = tree.settings.dist.lengthSq(d[0], d[1], d[2]);
    if (apart <= reach) return true;
    const Wide beyond = apart - reach;
    // The right-hand side is at most D + D', so below 2^64: the square fits.
    return beyond <= reach && beyond * beyond <= 4 * Wide(tree.coverSq[s]) * tree.coverSq[t];
}

/// The box of a sphere, a voxel wider than needed so that rounding is no matter.
struct Box {
    Vec3d lo, hi;

    Box(const SphereTree& tree, int32_t id)
        : lo(tree.center[id] - Vec3d(tree.radius[id] + 1)),
          hi(tree.center[id] + Vec3d(tree.radius[id] + 1))
    {}
    void expand(const Box& o)
    {
        lo = openvdb::math::minComponent(lo, o.lo);
        hi = openvdb::math::maxComponent(hi, o.hi);
    }
    bool meets(const Box& o) const
    {
        for (int axis = 0; axis < 3; ++axis) {
            if (hi[axis] < o.lo[axis] || o.hi[axis] < lo[axis]) return false;
        }
        return true;
    }
};

/// The spheres of a level in a binary tree of boxes, halved at the median of the longest side.
class SphereBoxes {
public:
    SphereBoxes(const SphereTree& tree, const SphereTreeLevel& level)
        : mTree(tree), mIds(level.size())
    {
        std::iota(mIds.begin(), mIds.end(), level.begin);
        build(0, level.size());
    }

    /// Calls visit(id) for every sphere that meets sphere @a s.
    template <typename Visit>
    void visitMeeting(int32_t s, const Visit& visit) const
    {
        visitMeeting(0, s, Box(mTree, s), visit);
    }

private:
    static constexpr int32_t kLeafSize = 8;
    struct Node {
        Box box;
        int32_t begin, end;  ///< of mIds
        int32_t second = -1; ///< its second child (the first one follows it); -1 in a leaf
    };

    /// Depth is log2 of the level's size, as every node is halved: at most 31.
    void build(int32_t begin, int32_t end)
    {
        Node node{Box(mTree, mIds[begin]), begin, end};
        for (int32_t i = begin + 1; i < end; ++i) node.box.expand(Box(mTree, mIds[i]));
        const std::size_t place = mNodes.size();
        mNodes.push_back(node);
        if (end - begin <= kLeafSize) return;
        const int axis = int(openvdb::math::MaxIndex(node.box.hi - node.box.lo));
        const int32_t middle = begin + (end - begin) / 2;
        std::nth_element(mIds.begin() + begin, mIds.begin() + middle, mIds.begin() + end,
            [&](int32_t a, int32_t b) {
                const double ca = mTree.center[a][axis], cb = mTree.center[b][axis];
                return ca != cb ? ca < cb : a < b;
            });
        build(begin, middle);
        mNodes[place].second = int32_t(mNodes.size());
        build(middle, end);
    }

    template <typename Visit>
    void visitMeeting(int32_t place, int32_t s, const Box& box, const Visit& visit) const
    {
        const Node& node = mNodes[place];
        if (!node.box.meets(box)) return;
        if (node.second >= 0) {
            visitMeeting(place + 1, s, box, visit);
            visitMeeting(node.second, s, box, visit);
            return;
        }
        for (int32_t i = node.begin; i < node.end; ++i) {
            if (meet(mTree, s, mIds[i])) visit(mIds[i]);
        }
    }

    const SphereTree& mTree;
    std::vector<int32_t> mIds;
    std::vector<Node> mNodes;
};

/// Appends the edges from the level @a above to the level @a below it.
void addEdges(const SphereTree& tree, const SphereTreeLevel& above, const SphereTreeLevel& below,
    std::vector<DagEdge>& edges, openvdb::util::NullInterrupter* interrupter)
{
    constexpr int32_t kChunk = 256;
    constexpr int64_t kMaxEdges = int64_t(1) << 28; // 2 GiB of them
    const SphereBoxes boxes(tree, above);
    std::atomic<int64_t> found{int64_t(edges.size())};
    std::vector<std::vector<DagEdge>> ofChunk((below.size() + kChunk - 1) / kChunk);
    detail::parallelFor(ofChunk.size(), interrupter, [&](std::size_t chunk) {
        if (found > kMaxEdges) return; // reported below
        const int32_t first = below.begin + int32_t(chunk) * kChunk;
        for (int32_t s = first; s < std::min(first + kChunk, below.end); ++s) {
            boxes.visitMeeting(s, [&](int32_t t) { ofChunk[chunk].push_back({t, s}); });
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
    tbb::parallel_sort(edges.begin(), edges.end());
    return edges;
}

} // namespace openvdb_spheretree
