// SPDX-License-Identifier: Apache-2.0
/// @file NodePainter.h
/// @brief Draws balls into a slab of a lower internal node, of 128^3 voxels.
///
/// 1. Balls smaller than a leaf are drawn at once, as stamps or row by row.
/// 2. The others are sorted into groups of 32^3, and from there into leaves. A group or leaf inside
///    one of them is full. In others, balls that add nothing are left out (PowerCull.h).
/// 3. What is left is drawn leaf by leaf, on mask words.

#pragma once

#include "BallLists.h"
#include "NodeCanvas.h"
#include "PowerCull.h"

#include <vector>

namespace openvdb_spheretree {
namespace detail {

/// Memory of one thread, for one slab after the other.
class NodePainter {
public:
    /// The slab must have been begun on the canvas.
    void draw(const ClippedSphere* balls, const std::vector<int32_t>& ofNode)
    {
        mLarge.clear();
        for (const int32_t i : ofNode) {
            if (!canvas.touches(balls[i])) continue;
            if (NodeCanvas::isSmall(balls[i])) canvas.drawSmall(balls[i]);
            else mLarge.push_back(i);
        }
        if (mLarge.empty()) return;
        mGroups.build(balls, mLarge.data(), mLarge.data() + mLarge.size(), canvas.origin(),
            NodeCanvas::kLog2, NodeCanvas::kGroupLog2, {canvas.slab(), canvas.slab()});
        for (int group = canvas.firstGroup(); group < canvas.endGroup(); ++group)
            drawGroup(balls, group);
    }

    NodeCanvas canvas;

private:
    void drawGroup(const ClippedSphere* balls, int group)
    {
        if (mGroups.full(group)) {
            canvas.fillGroup(group);
            return;
        }
        mOfGroup.assign(mGroups.begin(group), mGroups.end(group));
        if (mOfGroup.empty() || canvas.isFull(group)) return;
        const openvdb::Coord origin = mGroups.childOrigin(group);
        mCull.cull(balls, origin.data(), 1 << NodeCanvas::kGroupLog2, mOfGroup);
        mLeaves.build(balls, mOfGroup.data(), mOfGroup.data() + mOfGroup.size(), origin,
            NodeCanvas::kGroupLog2, NodeCanvas::kLeafLog2);
        for (int leaf = 0; leaf < 64; ++leaf) drawLeaf(balls, group, leaf);
    }

    void drawLeaf(const ClippedSphere* balls, int group, int leaf)
    {
        if (mLeaves.full(leaf)) {
            canvas.fillLeaf(group, leaf);
            return;
        }
        mOfLeaf.assign(mLeaves.begin(leaf), mLeaves.end(leaf));
        if (mOfLeaf.empty() || canvas.isFull(group, leaf)) return;
        const openvdb::Coord origin = mLeaves.childOrigin(leaf);
        mCull.cull(balls, origin.data(), 1 << NodeCanvas::kLeafLog2, mOfLeaf);
        for (const int32_t i : mOfLeaf) canvas.drawLeaf(balls[i], group, leaf, origin);
    }

    BallLists mGroups, mLeaves;
    PowerCull mCull;
    std::vector<int32_t> mLarge, mOfGroup, mOfLeaf;
};

} // namespace detail
} // namespace openvdb_spheretree
