// SPDX-License-Identifier: Apache-2.0
#include "SphereNodes.h"

#include "BallLists.h"
#include "NodeCanvas.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/ParallelSort.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Coord;
using openvdb::MaskTree;
using openvdb::util::NullInterrupter;

/// Balls that are sorted in one go: enough to be worth the lists of an upper node's 32^3 children,
/// and few enough for entries, 2^13 * 2^15 at most, to be counted in 32 bits.
constexpr std::size_t kBallsAtATime = 8192;

using NodesByOrigin = std::map<Coord, NodeSpheres>; // x slowest

void enterUpperNode(
    NodesByOrigin& nodes, const Coord& origin, const ClippedSphere& ball, int32_t index)
{
    NodeSpheres& node = nodes[origin];
    const Coord last = origin.offsetBy((1 << kUpperLog2) - 1);
    if (node.full || !ball.touches(origin.data(), last.data())) return;
    node.full = ball.contains(origin.data(), last.data());
    node.balls.push_back(index);
}

/// By multiplication: negative numbers must not be shifted to the left.
Coord cornerOf(const Coord& upperNode)
{
    constexpr int32_t kSide = 1 << kUpperLog2;
    return {upperNode[0] * kSide, upperNode[1] * kSide, upperNode[2] * kSide};
}

/// @param visited  nodes so far, of this and other balls
void enterUpperNodes(NodesByOrigin& nodes, const ClippedSphere& ball, int32_t index,
    const ClipMask& clipMask, int64_t& visited, NullInterrupter* interrupter)
{
    const openvdb::CoordBBox range(Coord(ball.lo) >> kUpperLog2, Coord(ball.hi) >> kUpperLog2);
    if (!clipMask.everywhere() && range.volume() > clipMask.upperNodes().size()) {
        checkInterrupt(interrupter);
        for (const Coord& origin : clipMask.upperNodes()) {
            if (range.isInside(origin >> kUpperLog2)) enterUpperNode(nodes, origin, ball, index);
        }
        return;
    }
    for (auto at = range.begin(); at; ++at) {
        if (++visited % 4096 == 0) checkInterrupt(interrupter);
        const Coord origin = cornerOf(*at);
        if (clipMask.hasUpperNode(origin)) enterUpperNode(nodes, origin, ball, index);
    }
}

/// Adds further balls to those of a node. They do not matter once it is full.
void join(NodeSpheres& node, bool full, const int32_t* begin, const int32_t* end)
{
    node.full = node.full || full;
    if (node.full) std::vector<int32_t>().swap(node.balls);
    else node.balls.insert(node.balls.end(), begin, end);
}

NodesByOrigin sortIntoUpperNodes(
    const ClippedSpheres& spheres, const ClipMask& clipMask, NullInterrupter* interrupter)
{
    const std::size_t count = spheres.order.size();
    std::vector<NodesByOrigin> parts((count + kBallsAtATime - 1) / kBallsAtATime);
    parallelFor(parts.size(), interrupter, [&](std::size_t part) {
        const std::size_t end = std::min((part + 1) * kBallsAtATime, count);
        int64_t visited = 0;
        for (std::size_t i = part * kBallsAtATime; i < end; ++i) {
            const int32_t index = spheres.order[i];
            enterUpperNodes(
                parts[part], spheres.balls[index], index, clipMask, visited, interrupter);
        }
    });
    NodesByOrigin nodes;
    for (NodesByOrigin& part : parts) {
        checkInterrupt(interrupter);
        for (const auto& [origin, some] : part) {
            const int32_t* const begin = some.balls.data();
            join(nodes[origin], some.full, begin, begin + some.balls.size());
        }
        part = {};
    }
    return nodes;
}

/// Some of the balls of an upper node.
struct PartOfNode {
    Coord origin;
    const int32_t *begin, *end;
};

std::vector<PartOfNode> partsOf(const NodesByOrigin& nodes)
{
    std::vector<PartOfNode> parts;
    for (const auto& [origin, node] : nodes) {
        if (node.full) continue;
        const int32_t* const end = node.balls.data() + node.balls.size();
        for (const int32_t* at = node.balls.data(); at != end;) {
            const int32_t* const next = at + std::min(kBallsAtATime, std::size_t(end - at));
            parts.push_back({origin, at, next});
            at = next;
        }
    }
    return parts;
}

/// The children of an upper node that some balls reach into, in order, and which balls these are.
struct Children {
    struct Child {
        Coord origin;
        bool full;
        std::size_t end; ///< of its balls; they begin where the last child's end
    };
    std::vector<Child> children;
    std::vector<int32_t> balls;
};

Children childrenOf(const BallLists& lists, const ClipMask& clipMask)
{
    Children result;
    for (std::size_t child = lists.firstReached(); child < lists.endReached(); ++child) {
        const bool full = lists.full(child);
        if (!full && lists.begin(child) == lists.end(child)) continue;
        const Coord origin = lists.childOrigin(child);
        if (!clipMask.hasLowerNode(origin)) continue;
        if (!full) result.balls.insert(result.balls.end(), lists.begin(child), lists.end(child));
        result.children.push_back({origin, full, result.balls.size()});
    }
    return result;
}

/// Joins what balls of one upper node reach into, in the order of balls. @a parts are used up.
void joinNodes(Children* parts, Children* end, std::vector<NodeSpheres>& result)
{
    NodesByOrigin joined; // in the order of children
    for (; parts != end; ++parts) {
        const Children part = std::move(*parts);
        const int32_t* begin = part.balls.data();
        for (const Children::Child& child : part.children) {
            const int32_t* const last = part.balls.data() + child.end;
            join(joined[child.origin], child.full, begin, last);
            begin = last;
        }
    }
    for (auto& [origin, node] : joined) {
        node.origin = origin;
        result.push_back(std::move(node));
    }
}

} // namespace

ClipMask::ClipMask(const MaskTree* tree) : mTree(tree)
{
    if (!tree) return;
    for (auto i = tree->root().cbeginChildOn(); i; ++i) mUpperNodes.push_back(i.getCoord());
    for (auto i = tree->root().cbeginValueOn(); i; ++i) mUpperNodes.push_back(i.getCoord());
    std::sort(mUpperNodes.begin(), mUpperNodes.end());
}

ClipMask::Leaves ClipMask::leavesOf(const Coord& lowerNode) const
{
    Leaves leaves;
    const LowerNode* const node = mTree ? mTree->probeConstNode<LowerNode>(lowerNode) : nullptr;
    if (node) {
        leaves = node->getChildMask();
        leaves |= node->getValueMask();
    } else {
        leaves.set(everywhere() || mTree->isValueOn(lowerNode));
    }
    return leaves;
}

bool ClipMask::hasUpperNode(const Coord& origin) const
{
    return everywhere() || std::binary_search(mUpperNodes.begin(), mUpperNodes.end(), origin);
}

ClippedSpheres clipSpheres(const std::vector<ExactSphere>& spheres, const SphereMetric& metric,
    const openvdb::CoordBBox& clip, NullInterrupter* interrupter)
{
    enum class Kind : char { Empty, Small, Large };
    const int shift = shiftOf(metric);
    ClippedSpheres result;
    result.balls = makeLargeArray<ClippedSphere>(spheres.size());
    std::vector<Kind> kinds(spheres.size());
    parallelFor(spheres.size(), interrupter, [&](std::size_t i) {
        ClippedSphere& ball = result.balls[i];
        if (!clipSphere(spheres[i], metric.distance, shift, clip, ball)) return;
        kinds[i] = NodeCanvas::isSmall(ball) ? Kind::Small : Kind::Large;
    });
    std::vector<int32_t>& order = result.order;
    order.reserve(spheres.size());
    const auto add = [&](Kind kind) {
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            if (kinds[i] == kind) order.push_back(int32_t(i));
        }
    };
    add(Kind::Large);
    parallelSort(order.begin(), order.end(), interrupter, [&](int32_t a, int32_t b) {
        const int64_t first = result.balls[a].radiusSq, second = result.balls[b].radiusSq;
        return first != second ? first > second : a < b;
    });
    add(Kind::Small);
    return result;
}

SphereNodes sortIntoNodes(
    const ClippedSpheres& spheres, const ClipMask& clipMask, NullInterrupter* interrupter)
{
    const NodesByOrigin upperNodes = sortIntoUpperNodes(spheres, clipMask, interrupter);
    const std::vector<PartOfNode> parts = partsOf(upperNodes);
    std::vector<Children> children(parts.size());
    parallelForWithScratch<BallLists>(
        parts.size(), interrupter, [&](std::size_t i, BallLists& lists) {
            lists.build(spheres.balls.get(), parts[i].begin, parts[i].end, parts[i].origin,
                kUpperLog2, NodeCanvas::kLog2);
            children[i] = childrenOf(lists, clipMask);
        });
    SphereNodes result;
    for (const auto& [origin, node] : upperNodes) {
        if (node.full) result.fullUpperNodes.push_back(origin);
    }
    for (std::size_t i = 0, end = 0; i < parts.size(); i = end) {
        while (end < parts.size() && parts[end].origin == parts[i].origin) ++end;
        checkInterrupt(interrupter);
        joinNodes(children.data() + i, children.data() + end, result.lowerNodes);
    }
    return result;
}

} // namespace openvdb_spheretree::detail
