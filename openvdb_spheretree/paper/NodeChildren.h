// SPDX-License-Identifier: Apache-2.0
/// @file NodeChildren.h
/// @brief The way down a tree: nodes of a level by their parent, and the leaf balls below a node
/// that reach farthest.

#pragma once

#include <openvdb_spheretree/base/LargeArray.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

/// The nodes of a level by their parent on the next level up; both are counted from 0 within their
/// level. 4 bytes a node and 4 a parent.
class NodeChildren {
public:
    /// @param parent  of each node
    NodeChildren(const std::vector<int32_t>& parent, std::size_t parents);

    struct Range {
        const int32_t *first, *last;
        const int32_t* begin() const { return first; }
        const int32_t* end() const { return last; }
    };
    /// @return the children of a node, in their own order.
    Range of(int32_t node) const
    {
        return {
            mOrder.get() + mBegin[std::size_t(node)], mOrder.get() + mBegin[std::size_t(node) + 1]};
    }

private:
    std::vector<uint32_t> mBegin; ///< of each parent in mOrder, and its end
    LargeArray<int32_t> mOrder;
};

/// A search for the leaf balls below a node that reach farthest from its centre: a part of the tree
/// is left out if none of its leaf balls can matter. Of a level's leaf balls few are looked at:
/// cost is that of the nodes, not of leaves times levels.
///
/// A Reach answers reach(level, node): nothing below that node, which may be a leaf ball itself,
/// goes beyond this. A Visit answers visit(leaf): the most that is known now; what does not reach
/// beyond it is left out. Memory of one thread.
class FarthestLeaves {
public:
    /// @param below  [k]: nodes of level k by their parents on level k + 1
    explicit FarthestLeaves(const std::vector<NodeChildren>& below) : mBelow(below) {}

    /// Visits leaf balls below a node of @a level, 1 or more; at first all matter.
    template <typename Reach, typename Visit>
    void search(int level, int32_t node, const Reach& reach, const Visit& visit)
    {
        mMost = -1;
        descend(level, node, reach, visit);
    }

private:
    struct Child {
        double reach;
        int32_t node;
    };

    template <typename Reach, typename Visit>
    void descend(int level, int32_t node, const Reach& reach, const Visit& visit)
    {
        if (level == 1) return lookAtLeaves(node, reach, visit);
        // The child that reaches farthest comes first: its leaf balls rule out most others.
        const std::size_t begin = mChildren.size();
        std::size_t farthest = begin;
        for (const int32_t child : mBelow[std::size_t(level - 1)].of(node)) {
            const double r = reach(level - 1, child);
            if (r <= mMost) continue;
            mChildren.push_back({r, child});
            if (r > mChildren[farthest].reach) farthest = mChildren.size() - 1;
        }
        const std::size_t end = mChildren.size();
        if (begin < end) std::swap(mChildren[begin], mChildren[farthest]);
        for (std::size_t i = begin; i < end; ++i) {
            const Child child = mChildren[i]; // the list may move
            if (child.reach > mMost) descend(level - 1, child.node, reach, visit);
        }
        mChildren.resize(begin);
    }

    /// The leaf that reaches farthest, then those that the visit leaves in doubt.
    template <typename Reach, typename Visit>
    void lookAtLeaves(int32_t node, const Reach& reach, const Visit& visit)
    {
        const NodeChildren::Range leaves = mBelow[0].of(node);
        const std::size_t count = std::size_t(leaves.end() - leaves.begin());
        if (mReaches.size() < count) mReaches.resize(count);
        std::size_t farthest = 0;
        for (std::size_t i = 0; i < count; ++i) {
            mReaches[i] = reach(0, leaves.begin()[i]);
            if (mReaches[i] > mReaches[farthest]) farthest = i;
        }
        if (count == 0 || mReaches[farthest] <= mMost) return;
        mMost = visit(leaves.begin()[farthest]);
        for (std::size_t i = 0; i < count; ++i) {
            if (mReaches[i] > mMost && i != farthest) mMost = visit(leaves.begin()[i]);
        }
    }

    const std::vector<NodeChildren>& mBelow;
    std::vector<Child> mChildren; ///< those that are waiting, of all levels on the way
    std::vector<double> mReaches; ///< of the leaves of one node
    double mMost = 0;
};

} // namespace detail
} // namespace openvdb_spheretree
