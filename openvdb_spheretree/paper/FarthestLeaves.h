// SPDX-License-Identifier: Apache-2.0
/// @file FarthestLeaves.h
/// @brief The way down a tree to the leaf balls that reach farthest from a node's center.

#pragma once

#include <openvdb_spheretree/base/CompressedRows.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace openvdb_spheretree::detail {

/// A search for the leaf balls below a node that reach farthest from its center: a part of the tree
/// is left out if none of its leaf balls can matter. Of a level's leaf balls few are looked at:
/// cost is that of the nodes, not of leaf balls times levels. Tests: TestFarthestLeaves.cc.
///
/// A Reach answers reach(level, node): nothing below that node, which may be a leaf ball itself,
/// goes beyond this. A Visit answers visit(leaf): the most that is known now; what does not reach
/// beyond it is left out. Memory of one thread.
class FarthestLeaves {
public:
    /// @param below  [k]: nodes of level k by their parents on level k + 1
    explicit FarthestLeaves(const std::vector<CompressedRows>& below) : mBelow(below) {}

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
        if (level == 1) {
            // The leaf that reaches farthest, then those that the visit leaves in doubt.
            const NodeSpan leaves = mBelow[0][node];
            const std::size_t count = leaves.size();
            if (mReaches.size() < count) mReaches.resize(count);
            std::size_t farthest = 0;
            for (std::size_t i = 0; i < count; ++i) {
                mReaches[i] = reach(0, leaves[i]);
                if (mReaches[i] > mReaches[farthest]) farthest = i;
            }
            if (count == 0 || mReaches[farthest] <= mMost) return;
            mMost = visit(leaves[farthest]);
            for (std::size_t i = 0; i < count; ++i) {
                if (mReaches[i] > mMost && i != farthest) mMost = visit(leaves[i]);
            }
            return;
        }
        // The child that reaches farthest comes first: its leaf balls rule out most others.
        const std::size_t begin = mChildren.size();
        std::size_t farthest = begin;
        for (const int32_t child : mBelow[std::size_t(level - 1)][node]) {
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

    const std::vector<CompressedRows>& mBelow;
    std::vector<Child> mChildren; ///< those that are waiting, of all levels on the way
    std::vector<double> mReaches; ///< of the leaves of one node
    double mMost = 0;
};

} // namespace openvdb_spheretree::detail
