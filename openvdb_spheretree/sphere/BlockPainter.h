// SPDX-License-Identifier: Apache-2.0
/// @file BlockPainter.h
/// @brief Draws balls into a slab of a block of 128^3 voxels.
///
/// 1. Balls smaller than a leaf are drawn at once, as stamps or row by row.
/// 2. The others are sorted into cells of 32^3, and from there into leaves; a cell or leaf inside
///    one of them is full, and nothing else is drawn there. In each, balls that add nothing to
///    others are left out (PowerCull.h).
/// 3. What is left is drawn leaf by leaf, on mask words.
///
/// Kept from slab to slab by a thread, as its memory is reused.

#pragma once

#include "BallLists.h"
#include "BlockCanvas.h"
#include "PowerCull.h"

#include <vector>

namespace openvdb_spheretree {
namespace detail {

class BlockPainter {
public:
    /// The slab must have been begun on the canvas.
    void draw(const ClippedSphere* balls, const std::vector<int32_t>& ofBlock)
    {
        mLarge.clear();
        for (const int32_t i : ofBlock) {
            if (!canvas.touches(balls[i])) continue;
            if (BlockCanvas::isSmall(balls[i])) canvas.drawSmall(balls[i]);
            else mLarge.push_back(i);
        }
        if (mLarge.empty()) return;
        mCells.build(balls, mLarge.data(), mLarge.data() + mLarge.size(), canvas.origin(),
            BlockCanvas::kLog2, BlockCanvas::kCellLog2, {canvas.slab(), canvas.slab()});
        for (int cell = canvas.firstCell(); cell < canvas.endCell(); ++cell) drawCell(balls, cell);
    }

    BlockCanvas canvas;

private:
    void drawCell(const ClippedSphere* balls, int cell)
    {
        if (mCells.full(cell)) {
            canvas.fillCell(cell);
            return;
        }
        mOfCell.assign(mCells.begin(cell), mCells.end(cell));
        if (mOfCell.empty() || canvas.isFull(cell)) return;
        const openvdb::Coord origin = mCells.childOrigin(cell);
        mCull.cull(balls, origin.data(), 1 << BlockCanvas::kCellLog2, mOfCell);
        mLeaves.build(balls, mOfCell.data(), mOfCell.data() + mOfCell.size(), origin,
            BlockCanvas::kCellLog2, BlockCanvas::kLeafLog2);
        for (int leaf = 0; leaf < 64; ++leaf) drawLeaf(balls, cell, leaf);
    }

    void drawLeaf(const ClippedSphere* balls, int cell, int leaf)
    {
        if (mLeaves.full(leaf)) {
            canvas.fillLeaf(cell, leaf);
            return;
        }
        mOfLeaf.assign(mLeaves.begin(leaf), mLeaves.end(leaf));
        if (mOfLeaf.empty() || canvas.isFull(cell, leaf)) return;
        const openvdb::Coord origin = mLeaves.childOrigin(leaf);
        mCull.cull(balls, origin.data(), 1 << BlockCanvas::kLeafLog2, mOfLeaf);
        for (const int32_t i : mOfLeaf) canvas.drawLeaf(balls[i], cell, leaf, origin);
    }

    BallLists mCells, mLeaves;
    PowerCull mCull;
    std::vector<int32_t> mLarge, mOfCell, mOfLeaf;
};

} // namespace detail
} // namespace openvdb_spheretree
