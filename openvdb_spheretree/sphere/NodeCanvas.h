// SPDX-License-Identifier: Apache-2.0
/// @file NodeCanvas.h
/// @brief The 128^3 voxels of a lower internal node, to draw balls into, slab by slab.
///
/// A slab is a quarter of the node, 32 voxels thick along x. Slabs have no leaf in common, nor a
/// word of the node's masks, so threads may share a node. Within a slab, leaves stand in groups of
/// 4^3 (32^3 voxels): a word tells which of them are full. Nothing is drawn to these.

#pragma once

#include "BallStamps.h"
#include "ClippedSphere.h"
#include "LeafVoxels.h"

#include <algorithm>
#include <vector>

namespace openvdb_spheretree::detail {

class NodeCanvas {
public:
    static constexpr int kLog2 = 7; ///< of the node's side
    static constexpr int kGroupLog2 = 5, kLeafLog2 = 3;
    static constexpr int kSlabs = 4, kSlabGroups = 16;

    /// @return whether the ball is too small to hold a leaf, some corner of which is 3.5 voxels or
    /// more away along each axis.
    static bool isSmall(const ClippedSphere& ball)
    {
        const int64_t corner = inUnits(7, ball.shift - 1);
        return ball.radiusSq < ball.distance.lengthSq(corner, corner, corner);
    }

    NodeCanvas() : mMasks(64 * 64, LeafMask{}) {}

    /// Starts on a slab of a node; the canvas must be clean.
    void begin(const openvdb::Coord& origin, int slab)
    {
        mOrigin = origin;
        mSlab = slab;
    }
    int slab() const { return mSlab; }
    /// Its groups are [firstGroup, endGroup), x slowest.
    int firstGroup() const { return kSlabGroups * mSlab; }
    int endGroup() const { return kSlabGroups * (mSlab + 1); }
    /// @return whether the ball's box reaches into the slab.
    bool touches(const ClippedSphere& ball) const
    {
        const int32_t slab = (mOrigin[0] >> kGroupLog2) + mSlab; // of all of space
        return ball.lo[0] >> kGroupLog2 <= slab && ball.hi[0] >> kGroupLog2 >= slab;
    }

    /// @return the node's origin.
    const openvdb::Coord& origin() const { return mOrigin; }

    void fillGroup(int group) { mFull[group] = kAllOn; }
    /// Nothing is drawn to a leaf that is full.
    void fillLeaf(int group, int leaf) { mFull[group] |= bit(leaf); }
    bool isFull(int group) const { return mFull[group] == kAllOn; }
    bool isFull(int group, int leaf) const { return mFull[group] & bit(leaf); }

    /// Draws what of a ball is in the slab.
    void drawSmall(const ClippedSphere& ball)
    {
        if (BallStamps::has(ball)) {
            drawStamp(ball, mStamps.of(ball));
            return;
        }
        forEachRow(ball, mOrigin, 1 << kLog2, [&](int32_t x, int32_t y, int32_t lo, int32_t hi) {
            if (x >> kGroupLog2 != mSlab) return;
            for (int32_t z = lo & ~7; z <= hi && lo <= hi; z += 8) { // from leaf to leaf
                const int group = inFours(x >> 5, y >> 5, z >> 5);
                const int leaf = inFours(x >> 3, y >> 3, z >> 3);
                const int first = std::max(lo - z, 0), last = std::min(hi - z, 7);
                mDrawn[group] |= bit(leaf);
                maskOf(group, leaf)[x & 7] |= rowBits(first, last) << (8 * (y & 7));
            }
        });
    }

    /// Draws the part of a ball that is in a leaf; @a origin is the leaf's.
    void drawLeaf(const ClippedSphere& ball, int group, int leaf, const openvdb::Coord& origin)
    {
        if (isFull(group, leaf)) return;
        LeafMask& mask = maskOf(group, leaf);
        mDrawn[group] |= bit(leaf);
        addVoxelsOf(ball, origin, mask);
        if (mask.all()) fillLeaf(group, leaf);
    }

    /// @return a bit for each leaf of a group that is full, of the others for those drawn to.
    uint64_t full(int group) const { return mFull[group]; }
    uint64_t drawn(int group) const { return mDrawn[group] & ~mFull[group]; }
    const LeafMask& mask(int group, int leaf) const { return mMasks[64 * group + leaf]; }
    openvdb::Coord leafOrigin(int group, int leaf) const
    {
        return at(at(mOrigin, group >> 4, group >> 2 & 3, group & 3, kGroupLog2), leaf >> 4,
            leaf >> 2 & 3, leaf & 3, kLeafLog2);
    }
    /// Wipes a group, for the next slab.
    void clean(int group)
    {
        for (int leaf = 0; leaf < 64; ++leaf) {
            if (mDrawn[group] & bit(leaf)) maskOf(group, leaf) = LeafMask{};
        }
        mDrawn[group] = mFull[group] = 0;
    }

private:
    static constexpr uint64_t kAllOn = ~uint64_t(0);

    LeafMask& maskOf(int group, int leaf) { return mMasks[64 * group + leaf]; }
    static uint64_t bit(int leaf) { return uint64_t(1) << leaf; }
    static int inFours(int x, int y, int z) { return 16 * (x & 3) + 4 * (y & 3) + (z & 3); }
    static openvdb::Coord at(const openvdb::Coord& origin, int x, int y, int z, int log2)
    {
        return origin.offsetBy(x << log2, y << log2, z << log2);
    }

    /// A stamp may begin or end in another node.
    void drawStamp(const ClippedSphere& ball, const BallStamp& stamp)
    {
        const int32_t y0 = (ball.lo[1] - mOrigin[1]) >> kLeafLog2; // in leaves
        const int32_t z0 = (ball.lo[2] - mOrigin[2]) >> kLeafLog2;
        const auto isOut = [](int32_t i, int log2) { return uint32_t(i) >> log2 != 0; };
        for (int32_t i = 0; i <= ball.hi[0] - ball.lo[0]; ++i) {
            const int32_t x = ball.lo[0] + i - mOrigin[0];
            if (x >> kGroupLog2 != mSlab) continue;
            for (int n = 0; n < 4; ++n) {
                const int32_t y = y0 + (n >> 1), z = z0 + (n & 1);
                const uint64_t word = stamp.slices[i][n];
                if (!word || isOut(y, kLog2 - kLeafLog2) || isOut(z, kLog2 - kLeafLog2)) continue;
                const int group = inFours(x >> 5, y >> 2, z >> 2), leaf = inFours(x >> 3, y, z);
                mDrawn[group] |= bit(leaf);
                maskOf(group, leaf)[x & 7] |= word;
            }
        }
    }

    openvdb::Coord mOrigin;
    int mSlab = 0;
    BallStamps mStamps;
    std::vector<LeafMask> mMasks; ///< by group and leaf
    uint64_t mFull[64] = {}, mDrawn[64] = {};
};

} // namespace openvdb_spheretree::detail
