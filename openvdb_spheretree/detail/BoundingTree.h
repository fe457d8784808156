// SPDX-License-Identifier: Apache-2.0
/// @file detail/BoundingTree.h
/// @brief A bounding volume hierarchy: which of many bodies may a ball meet, or a ray.
///
/// A binary tree, top down. Every node has a box and a ball around all that is below it. Balls along
/// a medial axis overlap so much that a point of their surface lies in the boxes of hundreds; the
/// bounding ball of balls of about one centre and radius is tight where their box is not. (Measured
/// on the 138,157 leaf balls of dragon-512: a ray to the sky tests 82 balls and 262 nodes, with
/// boxes alone 680 and 708.) So nodes are split by centre or by radius, whichever spreads most,
/// where the surface area heuristic (Goldsmith and Salmon 1987; in 16 bins, Wald 2007) finds the
/// cheapest place, and deep down at the median.
///
/// Bounds are floats rounded outwards: a query may be told of a body that it misses by a hair, and is
/// told of every one that it meets. The same bodies give the same tree. Cost: O(n log n) to build,
/// 52 bytes a node. Tests: TestRayScene.cc, TestIntersectionDag.cc.

#pragma once

#include "Ray.h"

#include <openvdb/math/BBox.h>
#include <openvdb/util/NullInterrupter.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

using Box = openvdb::math::BBox<openvdb::Vec3d>;

/// A ball and a box, both around one body.
struct Bound {
    openvdb::Vec3d center;
    double radius;
    Box box;
    /// No ray enters the body that starts with its centre further behind it than this. A ball is
    /// entered from before its centre alone, so that is 0, and of the crowd that a ray leaves when
    /// it starts on a surface, nearly all is behind it.
    double behind;

    /// Of a body, whatever it is, within this ball.
    static Bound ofBall(const openvdb::Vec3d& center, double radius)
    {
        const openvdb::Vec3d reach(radius);
        return {center, radius, Box(center - reach, center + reach), radius};
    }
    static Bound ofBox(const Box& box)
    {
        const double radius = (box.max() - box.min()).length() / 2;
        return {box.getCenter(), radius, box, radius};
    }
};

class BoundingTree {
public:
    /// @throw Interrupted if the interrupter (may be null) said so
    explicit BoundingTree(
        const std::vector<Bound>& bounds, openvdb::util::NullInterrupter* interrupter = nullptr);

    /// The bodies by number, in the order of the tree's leaves: what is stored in this order lies
    /// together in memory when it is asked for together. @a place in a visit is an index of it.
    const std::vector<int32_t>& order() const { return mOrder; }

    /// Calls visit(place) for every body whose bound meets @a bound.
    template <typename Visit>
    void visitMeeting(const Bound& bound, const Visit& visit) const
    {
        const auto callVisit = [&](int32_t place, double far) {
            visit(place);
            return far;
        };
        walk([&](const Node& node) { return node.meets(bound) ? 0.0 : kMiss; }, callVisit, 0.0);
    }

    /// Calls visit(place, far) for every body whose bound the ray meets no further away than @a far,
    /// in about the order in which it meets them. The visit returns the new `far`: that of the hit
    /// found, say, or a negative number to end.
    template <typename Visit>
    void visitAlong(const Ray& ray, double far, const Visit& visit) const
    {
        walk([&](const Node& node) { return node.entry(ray); }, visit, far);
    }

private:
    static constexpr double kMiss = 1e300;
    /// Splits by cost down to this depth, then halves: at most 31 levels more.
    static constexpr int kCostDepth = 48;
    static constexpr int kDeepest = kCostDepth + 31;

    struct Node {
        std::array<float, 3> lo, hi, center;
        float radius = 0, behind = 0; ///< as in Bound
        /// Of its bodies, in order(); of an inner node the first of two children.
        int32_t first = 0;
        int32_t count = 0; ///< of its bodies; 0 in an inner node

        bool meets(const Bound& bound) const;
        /// Where the ray enters both box and ball, or kMiss.
        double entry(const Ray& ray) const;
    };
    struct Builder;

    /// Nearer child first. Each step down leaves one child waiting: kDeepest of them at most.
    template <typename Entry, typename Visit>
    void walk(const Entry& entry, const Visit& visit, double far) const
    {
        std::array<std::pair<double, int32_t>, kDeepest + 1> waiting;
        int size = 0;
        if (!mNodes.empty()) waiting[size++] = {entry(mNodes[0]), 0};
        while (size > 0) {
            const auto [distance, index] = waiting[--size];
            if (distance > far) continue;
            const Node& node = mNodes[index];
            for (int32_t i = 0; i < node.count; ++i) far = visit(node.first + i, far);
            if (node.count > 0) continue;
            std::pair<double, int32_t> a(entry(mNodes[node.first]), node.first);
            std::pair<double, int32_t> b(entry(mNodes[node.first + 1]), node.first + 1);
            if (a.first < b.first) std::swap(a, b);
            if (a.first <= far) waiting[size++] = a;
            if (b.first <= far) waiting[size++] = b;
        }
    }

    std::vector<Node> mNodes;
    std::vector<int32_t> mOrder;
};

inline bool BoundingTree::Node::meets(const Bound& bound) const
{
    double apartSq = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (double(hi[axis]) < bound.box.min()[axis]) return false;
        if (bound.box.max()[axis] < double(lo[axis])) return false;
        const double apart = double(center[axis]) - bound.center[axis];
        apartSq += apart * apart;
    }
    const double reach = double(radius) + bound.radius;
    return apartSq <= reach * reach;
}

/// The last factor is for the rounding of the box test (Ize, Robust BVH Ray Traversal, 2013).
inline double BoundingTree::Node::entry(const Ray& ray) const
{
    double near = 0, far = kMiss / 2;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (double(lo[axis]) - ray.origin[axis]) * ray.inverse[axis];
        const double b = (double(hi[axis]) - ray.origin[axis]) * ray.inverse[axis];
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
    }
    if (near > far * (1 + 1e-15)) return kMiss;
    const openvdb::Vec3d toCenter(double(center[0]) - ray.origin[0],
        double(center[1]) - ray.origin[1], double(center[2]) - ray.origin[2]);
    const double nearest = toCenter.dot(ray.direction);
    if (nearest < -double(behind)) return kMiss;
    const double asideSq = (toCenter - nearest * ray.direction).lengthSqr();
    const double halfSq = double(radius) * double(radius) - asideSq;
    if (halfSq < 0) return kMiss;
    return std::max(near, nearest - std::sqrt(halfSq));
}

} // namespace detail
} // namespace openvdb_spheretree
