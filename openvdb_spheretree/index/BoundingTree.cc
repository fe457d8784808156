// SPDX-License-Identifier: Apache-2.0
#include "BoundingTree.h"

#include <openvdb_spheretree/base/Parallel.h>

#include <openvdb/math/Math.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Vec3d;

constexpr int32_t kLeafSize = 1; ///< eight of them are tested at once
constexpr int kBins = 16;
constexpr int kAxes = 4; ///< the center's three, and the radius
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double coordinate(const Bound& bound, int axis)
{
    return axis < 3 ? bound.center[axis] : bound.radius;
}

/// Around some bodies: their box, and the range of their centers and radii.
struct Extent {
    Box box;
    std::array<double, kAxes> lo{kInfinity, kInfinity, kInfinity, kInfinity};
    std::array<double, kAxes> hi{-kInfinity, -kInfinity, -kInfinity, -kInfinity};

    void add(const Bound& bound)
    {
        box.expand(bound.box);
        for (int axis = 0; axis < kAxes; ++axis) {
            lo[axis] = std::min(lo[axis], coordinate(bound, axis));
            hi[axis] = std::max(hi[axis], coordinate(bound, axis));
        }
    }
    void add(const Extent& o)
    {
        if (o.box.empty()) return;
        box.expand(o.box);
        for (int axis = 0; axis < kAxes; ++axis) {
            lo[axis] = std::min(lo[axis], o.lo[axis]);
            hi[axis] = std::max(hi[axis], o.hi[axis]);
        }
    }
    Vec3d center() const { return (Vec3d(lo[0], lo[1], lo[2]) + Vec3d(hi[0], hi[1], hi[2])) / 2; }
    int widest() const
    {
        int widest = 0;
        for (int axis = 1; axis < kAxes; ++axis) {
            if (hi[axis] - lo[axis] > hi[widest] - lo[widest]) widest = axis;
        }
        return widest;
    }
    /// Half the surface of the box or of a ball around everything, whichever is less: what the
    /// number of rays through both grows with.
    double halfArea() const
    {
        const Vec3d side = box.max() - box.min();
        const double ofBox = side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
        const Vec3d spread(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
        const double radius = spread.length() / 2 + hi[3];
        return std::min(ofBox, 2 * openvdb::math::pi<double>() * radius * radius);
    }
};

/// The slices that bodies fall into along the axis on which they spread most.
struct Bins {
    explicit Bins(const Extent& all) : axis(all.widest()), lowest(all.lo[axis])
    {
        const double width = all.hi[axis] - lowest;
        scale = width > 0 ? kBins / width : 0;
    }
    int binOf(const Bound& bound) const
    {
        return std::min(int((coordinate(bound, axis) - lowest) * scale), kBins - 1);
    }
    /// @return the bin that the second half is to start with for the least cost; 0 if all are in
    ///         one bin.
    int cheapestSplit() const
    {
        std::array<double, kBins> costOfFirst;
        Extent first, second;
        int32_t before = 0, after = 0;
        for (int i = 0; i + 1 < kBins; ++i) {
            first.add(extent[i]);
            before += count[i];
            costOfFirst[i + 1] = before ? before * first.halfArea() : kInfinity;
        }
        double cheapest = kInfinity;
        int best = 0;
        for (int i = kBins - 1; i > 0; --i) {
            second.add(extent[i]);
            after += count[i];
            const double cost = after ? costOfFirst[i] + after * second.halfArea() : kInfinity;
            if (cost < cheapest) cheapest = cost, best = i;
        }
        return best;
    }

    int axis;
    double lowest, scale;
    std::array<int32_t, kBins> count = {};
    std::array<Extent, kBins> extent = {};
};

} // namespace

/// A binary tree first; then nodes of it are joined, until a node has kWidth children.
struct BoundingTree::Builder {
    struct Node {
        std::array<float, 3> lo, hi, center;
        float radius = 0, behind = 0;
        int32_t first = 0; ///< of its bodies, or of its two children
        int32_t count = 0; ///< of its bodies; 0 in an inner node
    };

    const std::vector<Bound>& bounds;
    openvdb::util::NullInterrupter* interrupter;
    std::vector<int32_t>& order;
    std::vector<Node> nodes{};

    /// Fills in node @a index, of the bodies in [begin, end) of the order. Recursion is kDeepest
    /// deep at most: by cost down to kCostDepth, and halving 2^31 bodies takes 31 steps.
    void build(int32_t index, int32_t begin, int32_t end, int depth)
    {
        constexpr int32_t kCheckFrom = 4096; // asking costs more than a small node
        if (end - begin > kCheckFrom) checkInterrupt(interrupter);
        Extent extent;
        for (int32_t i = begin; i < end; ++i) extent.add(bounds[order[i]]);
        setBound(nodes[index], extent, begin, end);
        if (end - begin <= kLeafSize) {
            nodes[index].first = begin;
            nodes[index].count = end - begin;
            return;
        }
        const int32_t middle = split(begin, end, extent, depth);
        const auto child = int32_t(nodes.size());
        nodes[index].first = child;
        nodes.resize(nodes.size() + 2);
        build(child, begin, middle, depth + 1);
        build(child + 1, middle, end, depth + 1);
    }

    void setBound(Node& node, const Extent& extent, int32_t begin, int32_t end) const
    {
        constexpr float kUp = std::numeric_limits<float>::infinity();
        const Vec3d center = extent.center();
        for (int axis = 0; axis < 3; ++axis) {
            node.lo[axis] = std::nextafter(float(extent.box.min()[axis]), -kUp);
            node.hi[axis] = std::nextafter(float(extent.box.max()[axis]), kUp);
            node.center[axis] = float(center[axis]);
        }
        const Vec3d rounded(node.center[0], node.center[1], node.center[2]);
        double radius = 0, behind = 0;
        for (int32_t i = begin; i < end; ++i) {
            const Bound& bound = bounds[order[i]];
            const double apart = (bound.center - rounded).length();
            radius = std::max(radius, apart + bound.radius);
            behind = std::max(behind, apart + bound.behind);
        }
        constexpr double kMore = 1e-6; // more than all rounding here and in queries
        node.radius = float(radius * (1 + kMore));
        node.behind = float(behind + radius * kMore);
    }

    int32_t split(int32_t begin, int32_t end, const Extent& extent, int depth)
    {
        Bins bins(extent);
        int bin = 0;
        if (depth < kCostDepth && bins.scale > 0) {
            for (int32_t i = begin; i < end; ++i) {
                const Bound& bound = bounds[order[i]];
                const int its = bins.binOf(bound);
                ++bins.count[its];
                bins.extent[its].add(bound);
            }
            bin = bins.cheapestSplit();
        }
        if (bin == 0) return halve(begin, end, bins.axis);
        const auto first = order.begin() + begin;
        const auto isFirst = [&](int32_t body) { return bins.binOf(bounds[body]) < bin; };
        return begin + int32_t(std::stable_partition(first, order.begin() + end, isFirst) - first);
    }

    int32_t halve(int32_t begin, int32_t end, int axis)
    {
        const int32_t middle = begin + (end - begin) / 2;
        std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
            [&](int32_t a, int32_t b) {
                const double ca = coordinate(bounds[a], axis), cb = coordinate(bounds[b], axis);
                return ca != cb ? ca < cb : a < b;
            });
        return middle;
    }

    /// @return the children of a wide node that stands for node @a index: it is opened, then the
    ///         largest of those that can be, as long as there is room.
    std::vector<int32_t> childrenOf(int32_t index) const
    {
        std::vector<int32_t> children{index};
        while (int(children.size()) < BoundingNode::kWidth) {
            const auto less = [&](int32_t a, int32_t b) {
                const bool innerA = nodes[a].count == 0, innerB = nodes[b].count == 0;
                return innerA != innerB ? innerB : nodes[a].radius < nodes[b].radius;
            };
            const auto largest = std::max_element(children.begin(), children.end(), less);
            if (nodes[*largest].count > 0) break;
            const int32_t first = nodes[*largest].first;
            *largest = first;
            children.push_back(first + 1);
        }
        return children;
    }

    /// Fills in @a wide[at] for node @a index. As deep as the binary tree at most.
    void join(int32_t index, std::size_t at, std::vector<BoundingNode>& wide) const
    {
        const std::vector<int32_t> children = childrenOf(index);
        for (int i = 0; i < int(children.size()); ++i) {
            const Node& child = nodes[children[i]];
            BoundingNode& node = wide[at];
            for (int axis = 0; axis < 3; ++axis) {
                node.lo[axis][i] = child.lo[axis];
                node.hi[axis][i] = child.hi[axis];
                node.center[axis][i] = child.center[axis];
            }
            node.radius[i] = child.radius;
            node.behind[i] = child.behind;
            node.count[i] = child.count;
            node.first[i] = child.count > 0 ? child.first : int32_t(wide.size());
            if (child.count > 0) continue;
            wide.emplace_back();
            join(children[i], wide.size() - 1, wide);
        }
    }
};

BoundingTree::BoundingTree(
    const std::vector<Bound>& bounds, openvdb::util::NullInterrupter* interrupter)
    : mOrder(bounds.size())
{
    if (bounds.empty()) return;
    std::iota(mOrder.begin(), mOrder.end(), 0);
    Builder builder{bounds, interrupter, mOrder};
    builder.nodes.reserve(2 * bounds.size());
    builder.nodes.resize(1);
    builder.build(0, 0, int32_t(bounds.size()), 0);
    mNodes.resize(1);
    builder.join(0, 0, mNodes);
}

} // namespace openvdb_spheretree::detail
