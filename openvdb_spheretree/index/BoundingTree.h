// SPDX-License-Identifier: Apache-2.0
/// @file BoundingTree.h
/// @brief A bounding volume hierarchy: which of many bodies may a ball meet, or a ray.
///
/// A binary tree is built from the top down; then its nodes are joined until a node has eight
/// children. Each has a box and a ball around all that is below it. Balls along a medial axis
/// overlap so much that a point of their surface lies in the boxes of hundreds; around balls of
/// about the same center and radius, a ball is tight where a box is not. (On the 138,157 leaf balls
/// of dragon-512, a ray to the sky tested 82 balls and 262 nodes of a binary tree, with boxes alone
/// 680 and 708.) So nodes are split by center or by radius, whichever spreads most, where the
/// surface area heuristic (Goldsmith and Salmon 1987; in 16 bins, Wald 2007) finds the cheapest
/// place, and deep down at the median.
///
/// Bounds are floats rounded outwards: a query finds every body that it meets, and some that it
/// misses by a hair. The same bodies give the same tree. Cost: O(n log n) to build, 416 bytes a
/// node. Tests: TestRayScene.cc, TestIntersectionDag.cc.

#pragma once

#include "BoundingNode.h"
#include "Ray.h"

#include <openvdb/math/BBox.h>
#include <openvdb/util/NodeMasks.h>
#include <openvdb/util/NullInterrupter.h>

#include <array>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

using Box = openvdb::math::BBox<openvdb::Vec3d>;

/// A ball and a box, both around one body.
struct Bound {
    openvdb::Vec3d center;
    double radius;
    Box box;
    /// A ray that starts with the center further behind it than this does not enter the body. For a
    /// ball it is 0: a ray enters it only where its center is ahead. So a ray that starts on a
    /// surface is not tested against the many balls that it leaves.
    double behind;

    /// Of any body within this ball.
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
    /// together in memory where it is visited together. @a place in a visit is an index of it.
    const std::vector<int32_t>& order() const { return mOrder; }

    /// Calls visit(place) for every body whose bound meets @a bound.
    template <typename Visit>
    void visitMeeting(const Bound& bound, const Visit& visit) const
    {
        const auto callVisit = [&](int32_t place, double far) {
            visit(place);
            return far;
        };
        const auto meeting = [&](const BoundingNode& node, double, Entries& entry) {
            return meets(node, bound, entry);
        };
        walk(meeting, callVisit, 0.0);
    }

    /// Calls visit(place, far) for every body whose bound the ray meets no further away than @a
    /// far, in about the order in which it meets them. The visit returns the new `far`: that of the
    /// hit found, say, or a negative number to end.
    template <typename Visit>
    void visitAlong(const Ray& ray, double far, const Visit& visit) const
    {
        const auto entered = [&](const BoundingNode& node, double reach, Entries& entry) {
            return entriesOf(node, ray, reach, entry);
        };
        walk(entered, visit, far);
    }

private:
    using Entries = BoundingNode::Each<double>;
    /// Splits by cost down to this depth, then halves: at most 31 levels more. A node of eight
    /// children stands for one of two children, and is no deeper.
    static constexpr int kCostDepth = 48;
    static constexpr int kDeepest = kCostDepth + 31;
    /// Each step down takes one of those that wait, and adds kWidth of them.
    static constexpr int kMostWaiting = kDeepest * (BoundingNode::kWidth - 1) + 1;

    struct Waiting {
        double distance;
        int32_t first, count; ///< as in BoundingNode
    };
    struct Builder;

    /// @return a bit for each child that meets @a bound; @a entry of these is 0.
    static uint32_t meets(const BoundingNode& node, const Bound& bound, Entries& entry)
    {
        uint32_t met = 0;
        for (int child = 0; child < BoundingNode::kWidth; ++child) {
            double apartSq = 0;
            bool isApart = node.first[child] == 0 && node.count[child] == 0; // no child
            for (int axis = 0; axis < 3; ++axis) {
                isApart |= double(node.hi[axis][child]) < bound.box.min()[axis];
                isApart |= bound.box.max()[axis] < double(node.lo[axis][child]);
                const double apart = double(node.center[axis][child]) - bound.center[axis];
                apartSq += apart * apart;
            }
            const double reach = double(node.radius[child]) + bound.radius;
            if (isApart || apartSq > reach * reach) continue;
            met |= 1u << child;
            entry[child] = 0;
        }
        return met;
    }

    /// Nearer child first.
    template <typename EntriesOf, typename Visit>
    void walk(const EntriesOf& entriesOf, const Visit& visit, double far) const
    {
        std::array<Waiting, kMostWaiting> waiting; // left as it is: filling it takes too long
        int size = 0;
        if (!mNodes.empty()) waiting[size++] = {0, 0, 0};
        while (size > 0) {
            const Waiting next = waiting[--size];
            if (next.distance > far) continue;
            for (int32_t i = 0; i < next.count; ++i) far = visit(next.first + i, far);
            if (next.count > 0) continue;
            const BoundingNode& node = mNodes[next.first];
            Entries entry;
            const int bottom = size;
            for (uint32_t left = entriesOf(node, far, entry); left != 0; left &= left - 1) {
                const auto child = openvdb::util::FindLowestOn(left);
                int at = size++;
                for (; at > bottom && waiting[at - 1].distance < entry[child]; --at) {
                    waiting[at] = waiting[at - 1];
                }
                waiting[at] = {entry[child], node.first[child], node.count[child]};
            }
        }
    }

    std::vector<BoundingNode> mNodes;
    std::vector<int32_t> mOrder;
};

} // namespace openvdb_spheretree::detail
