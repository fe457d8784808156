// SPDX-License-Identifier: Apache-2.0
/// @file BlockCanvas.h
/// @brief The 128^3 voxels of a block as mask words, to draw balls into, slab by slab.
///
/// A slab is a quarter of the block, 32 voxels thick along x: threads may share a block, since slabs
/// have no leaf in common, nor a word of the block's masks. Words are kept by cells of 32^3 and
/// leaves of 8^3, with a bit for leaves that are full: nothing is drawn to these.

#pragma once

#include "BallStamps.h"
#include "BallWords.h"

#include <algorithm>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

class BlockCanvas {
public:
    static constexpr int kLog2 = 7; ///< a block is OpenVDB's lower internal node
    static constexpr int kCellLog2 = 5, kLeafLog2 = 3;
    static constexpr int kSlabs = 4, kSlabCells = 16;

    /// @return whether the ball is too small to hold a leaf, some corner of which is 3.5 voxels or
    /// more away along each axis.
    static bool isSmall(const ClippedSphere& ball)
    {
        const int64_t corner = inUnits(7, ball.shift - 1);
        return ball.radiusSq < ball.distance.lengthSq(corner, corner, corner);
    }

    BlockCanvas() : mWords(64 * 64 * 8, 0) {}

    /// Starts on a slab of a block; the canvas must be clean.
    void begin(const openvdb::Coord& origin, int slab)
    {
        mOrigin = origin;
        mSlab = slab;
    }
    int slab() const { return mSlab; }
    /// Its cells are [firstCell, endCell), x slowest.
    int firstCell() const { return kSlabCells * mSlab; }
    int endCell() const { return kSlabCells * (mSlab + 1); }
    /// @return whether the ball's box reaches into the slab.
    bool touches(const ClippedSphere& ball) const
    {
        const int32_t slab = (mOrigin[0] >> kCellLog2) + mSlab; // of all of space
        return ball.lo[0] >> kCellLog2 <= slab && ball.hi[0] >> kCellLog2 >= slab;
    }

    /// Has balls pass over a leaf, as if it were full.
    void exclude(int cell, int leaf) { mFull[cell] |= bit(leaf); }

    /// @return the block's origin
    const openvdb::Coord& origin() const { return mOrigin; }

    void fillCell(int cell) { mFull[cell] = kAllOn; }
    void fillLeaf(int cell, int leaf) { mFull[cell] |= bit(leaf); }
    bool isFull(int cell) const { return mFull[cell] == kAllOn; }
    bool isFull(int cell, int leaf) const { return mFull[cell] & bit(leaf); }

    /// Draws what of a ball is in the slab.
    void drawSmall(const ClippedSphere& ball)
    {
        if (BallStamps::has(ball)) {
            drawStamp(ball, mStamps.of(ball));
            return;
        }
        forEachRow(ball, mOrigin, 1 << kLog2,
            [this](int32_t x, int32_t y, int32_t lo, int32_t hi) { drawRow(x, y, lo, hi); });
    }

    /// Draws the part of a ball that is in a leaf; @a origin is the leaf's.
    void drawLeaf(const ClippedSphere& ball, int cell, int leaf, const openvdb::Coord& origin)
    {
        if (isFull(cell, leaf)) return;
        uint64_t* word = &mWords[(64 * cell + leaf) * 8];
        mDrawn[cell] |= bit(leaf);
        orBallIntoWords(ball, origin, word);
        if (std::all_of(word, word + 8, [](uint64_t w) { return w == kAllOn; })) {
            fillLeaf(cell, leaf);
        }
    }

    /// @return a bit for each leaf of a cell that is full, of the others for those drawn to.
    uint64_t full(int cell) const { return mFull[cell]; }
    uint64_t drawn(int cell) const { return mDrawn[cell] & ~mFull[cell]; }
    /// @return the eight words of a leaf: word x, bit 8 y + z.
    const uint64_t* words(int cell, int leaf) const { return &mWords[(64 * cell + leaf) * 8]; }
    openvdb::Coord leafOrigin(int cell, int leaf) const
    {
        return at(at(mOrigin, cell >> 4, cell >> 2 & 3, cell & 3, kCellLog2), leaf >> 4,
            leaf >> 2 & 3, leaf & 3, kLeafLog2);
    }
    /// Wipes a cell, for the next slab.
    void clean(int cell)
    {
        for (int leaf = 0; leaf < 64; ++leaf) {
            if (!(mDrawn[cell] & bit(leaf))) continue;
            uint64_t* words = &mWords[(64 * cell + leaf) * 8];
            std::fill(words, words + 8, 0);
        }
        mDrawn[cell] = mFull[cell] = 0;
    }

private:
    static constexpr uint64_t kAllOn = ~uint64_t(0);

    static uint64_t bit(int leaf) { return uint64_t(1) << leaf; }
    static int inFours(int x, int y, int z) { return 16 * (x & 3) + 4 * (y & 3) + (z & 3); }
    static openvdb::Coord at(const openvdb::Coord& origin, int x, int y, int z, int log2)
    {
        return origin.offsetBy(x << log2, y << log2, z << log2);
    }

    /// A stamp may begin or end in another block.
    void drawStamp(const ClippedSphere& ball, const BallStamp& stamp)
    {
        const int32_t y0 = (ball.lo[1] - mOrigin[1]) >> kLeafLog2; // in leaves
        const int32_t z0 = (ball.lo[2] - mOrigin[2]) >> kLeafLog2;
        const auto isOut = [](int32_t i, int log2) { return uint32_t(i) >> log2 != 0; };
        for (int32_t i = 0; i <= ball.hi[0] - ball.lo[0]; ++i) {
            const int32_t x = ball.lo[0] + i - mOrigin[0];
            if (x >> kCellLog2 != mSlab) continue;
            for (int n = 0; n < 4; ++n) {
                const int32_t y = y0 + (n >> 1), z = z0 + (n & 1);
                const uint64_t word = stamp.slices[i][n];
                if (!word || isOut(y, kLog2 - kLeafLog2) || isOut(z, kLog2 - kLeafLog2)) continue;
                const int cell = inFours(x >> 5, y >> 2, z >> 2), leaf = inFours(x >> 3, y, z);
                mDrawn[cell] |= bit(leaf);
                mWords[(64 * cell + leaf) * 8 + (x & 7)] |= word;
            }
        }
    }

    /// Draws a row of z, which may be empty or cross leaves; coordinates from the block's corner.
    void drawRow(int32_t x, int32_t y, int32_t lo, int32_t hi)
    {
        if (x >> kCellLog2 != mSlab) return;
        for (int32_t z = lo & ~7; z <= hi && lo <= hi; z += 8) {
            const int cell = inFours(x >> 5, y >> 5, z >> 5);
            const int leaf = inFours(x >> 3, y >> 3, z >> 3);
            const int first = std::max(lo - z, 0), last = std::min(hi - z, 7);
            mDrawn[cell] |= bit(leaf);
            mWords[(64 * cell + leaf) * 8 + (x & 7)] |= rowBits(first, last) << (8 * (y & 7));
        }
    }

    openvdb::Coord mOrigin;
    int mSlab = 0;
    BallStamps mStamps;
    std::vector<uint64_t> mWords;
    uint64_t mFull[64] = {}, mDrawn[64] = {};
};

} // namespace detail
} // namespace openvdb_spheretree
