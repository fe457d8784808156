// SPDX-License-Identifier: Apache-2.0
/// @file detail/SphereRaster.cc
/// @brief Spheres to a sparse mask: sorted into cells, then drawn row by row.
///
/// 1. clipSpheres, sortLargerFirst: the spheres' boxes, clipped; empty ones dropped
/// 2. sortIntoRootCells, sortIntoBlocks: which spheres reach into which 4096^3 and 128^3 cell
/// 3. drawSlab, in parallel over quarters of 128^3 cells: see BlockPainter.h
///
/// A cell of 4096 or 128 wholly inside a single sphere (and the clip) becomes a tile and is not
/// descended; a leaf does when it is full. Clipping needs no step of its own, since every sphere's
/// box is clipped. Exact: integers throughout. OR does not depend on the order of spheres, hence
/// the result not on threads.

#include "SphereRaster.h"

#include "BallLists.h"
#include "BlockPainter.h"
#include "LargeArray.h"
#include "MaskNodes.h"
#include "Parallel.h"

#include <tbb/parallel_sort.h>

#include <atomic>
#include <map>
#include <memory>

namespace openvdb_spheretree {
namespace detail {
namespace {

using openvdb::Coord;
using openvdb::MaskTree;

constexpr int kRootCellLog2 = 12;

/// A 128^3 cell to be drawn.
struct Block {
    Coord origin;
    bool full = false;
    std::vector<int32_t> balls;
    std::unique_ptr<BlockNode> node; ///< of its own voxels; null if it is full
};

struct RootCell {
    bool full = false;
    std::vector<int32_t> balls;
};
using RootCells = std::map<Coord, RootCell>;

/// Where the object that the drawing is confined to has anything; everywhere if there is none.
class Wanted {
public:
    explicit Wanted(const MaskTree* tree) : mTree(tree)
    {
        if (!tree) return;
        for (auto i = tree->root().cbeginChildOn(); i; ++i) mRootCells.push_back(i.getCoord());
        for (auto i = tree->root().cbeginValueOn(); i; ++i) mRootCells.push_back(i.getCoord());
    }
    bool everywhere() const { return !mTree; }
    const std::vector<Coord>& rootCells() const { return mRootCells; }
    template <typename NodeType>
    bool has(const Coord& origin) const
    {
        return !mTree || mTree->probeConstNode<NodeType>(origin) || mTree->isValueOn(origin);
    }

private:
    const MaskTree* mTree;
    std::vector<Coord> mRootCells;
};

std::vector<Ball> clipSpheres(const std::vector<ExactSphere>& spheres, const SphereMetric& metric,
    const openvdb::CoordBBox& clip)
{
    const int shift = shiftOf(metric);
    std::vector<Ball> balls;
    resizeLarge(balls, spheres.size());
    std::vector<char> kept(spheres.size());
    parallelFor(spheres.size(), nullptr, [&](std::size_t i) {
        kept[i] = clippedBall(spheres[i], metric.distance, shift, clip, balls[i]);
    });
    std::size_t count = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (kept[i]) balls[count++] = balls[i];
    }
    balls.resize(count);
    return balls;
}

/// Larger balls to the front, largest first, since what they fill is not drawn again. The small
/// ones keep their order, which is mostly that of their centres, and so kind to caches.
void sortLargerFirst(std::vector<Ball>& balls)
{
    const auto small = std::partition(
        balls.begin(), balls.end(), [](const Ball& ball) { return !BlockCanvas::isSmall(ball); });
    tbb::parallel_sort(
        balls.begin(), small, [](const Ball& a, const Ball& b) { return a.coverSq > b.coverSq; });
}

void enterRootCell(RootCell& cell, const Coord& origin, const Ball& ball, int32_t index)
{
    if (cell.full || !ball.touches(origin.data(), 1 << kRootCellLog2)) return;
    cell.full = ball.contains(origin.data(), 1 << kRootCellLog2);
    cell.balls.push_back(index);
}

RootCells sortIntoRootCells(const std::vector<Ball>& balls, const Wanted& wanted,
    openvdb::util::NullInterrupter* interrupter)
{
    RootCells cells;
    for (const Coord& origin : wanted.rootCells()) cells[origin];
    for (int32_t i = 0; i < int32_t(balls.size()); ++i) {
        const Ball& ball = balls[i];
        openvdb::CoordBBox range(Coord(ball.lo) >> kRootCellLog2, Coord(ball.hi) >> kRootCellLog2);
        const bool many = range.volume() > cells.size();
        if (i % 1024 == 0 || many) checkInterrupt(interrupter);
        if (!wanted.everywhere() && many) {
            for (auto& [origin, cell] : cells) {
                const openvdb::Coord at = origin >> kRootCellLog2;
                if (range.isInside(at)) enterRootCell(cell, origin, ball, i);
            }
            continue;
        }
        int64_t visited = 0;
        for (auto at = range.begin(); at; ++at) {
            if (++visited % 4096 == 0) checkInterrupt(interrupter);
            const Coord origin = *at << kRootCellLog2;
            if (!wanted.everywhere() && !cells.count(origin)) continue;
            enterRootCell(cells[origin], origin, ball, i);
        }
    }
    return cells;
}

std::vector<Block> sortIntoBlocks(const RootCells& cells, const std::vector<Ball>& balls,
    const Wanted& wanted, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<Block> blocks;
    BallLists lists;
    for (const auto& [origin, cell] : cells) {
        checkInterrupt(interrupter);
        if (cell.full) continue;
        lists.build(balls, cell.balls.data(), cell.balls.data() + cell.balls.size(), origin,
            kRootCellLog2, BlockCanvas::kLog2);
        for (std::size_t child = 0; child < lists.size(); ++child) {
            if (!lists.full(child) && lists.begin(child) == lists.end(child)) continue;
            Block block;
            block.origin = lists.childOrigin(child);
            if (!wanted.has<BlockNode>(block.origin)) continue;
            block.full = lists.full(child);
            if (!block.full) block.balls.assign(lists.begin(child), lists.end(child));
            blocks.push_back(std::move(block));
        }
    }
    return blocks;
}

void excludeUnwanted(BlockCanvas& canvas, const Wanted& wanted)
{
    if (wanted.everywhere()) return;
    for (int cell = canvas.firstCell(); cell < canvas.endCell(); ++cell) {
        for (int leaf = 0; leaf < 64; ++leaf) {
            if (!wanted.has<LeafNode>(canvas.leafOrigin(cell, leaf))) canvas.exclude(cell, leaf);
        }
    }
}

bool allOn(const uint64_t words[8])
{
    return std::all_of(words, words + 8, [](uint64_t word) { return word == ~uint64_t(0); });
}

bool allOff(const uint64_t words[8])
{
    return std::all_of(words, words + 8, [](uint64_t word) { return word == 0; });
}

/// Moves the slab on the canvas to its node. A full leaf is a tile. Slabs of a node have no word of
/// its masks in common, so several threads may do this.
void storeSlab(const BlockCanvas& canvas, const Wanted& wanted, BlockNode& node)
{
    for (int cell = canvas.firstCell(); cell < canvas.endCell(); ++cell) {
        for (int l = 0; l < 64; ++l) {
            const bool full = canvas.full(cell) >> l & 1, drawn = canvas.drawn(cell) >> l & 1;
            if (!full && !drawn) continue;
            const Coord origin = canvas.leafOrigin(cell, l);
            if (!wanted.has<LeafNode>(origin)) continue;
            const uint64_t* words = canvas.words(cell, l);
            if (full || allOn(words)) {
                node.addTile(BlockNode::coordToOffset(origin), true, true);
                continue;
            }
            if (allOff(words)) continue; // a sphere came near, but holds no voxel of it
            auto leaf = std::make_unique<LeafNode>(origin);
            for (int x = 0; x < 8; ++x) leaf->getValueMask().getWord<uint64_t>(x) = words[x];
            node.addLeaf(leaf.release());
        }
    }
}

void drawSlab(const Block& block, int slab, const std::vector<Ball>& balls, const Wanted& wanted,
    BlockPainter& painter)
{
    BlockCanvas& canvas = painter.canvas;
    canvas.begin(block.origin, slab);
    excludeUnwanted(canvas, wanted);
    painter.draw(balls, block.balls);
    storeSlab(canvas, wanted, *block.node);
    for (int cell = canvas.firstCell(); cell < canvas.endCell(); ++cell) canvas.clean(cell);
}

void drawBlocks(std::vector<Block>& blocks, const std::vector<Ball>& balls, const Wanted& wanted,
    openvdb::util::NullInterrupter* interrupter)
{
    constexpr std::size_t kSlabs = BlockCanvas::kSlabs;
    parallelFor(blocks.size(), interrupter, [&](std::size_t i) {
        Block& block = blocks[i];
        if (!block.full) block.node = std::make_unique<BlockNode>(block.origin, false, false);
    });
    std::vector<std::atomic<std::size_t>> slabsLeft(blocks.size()); // there may be many balls
    for (auto& left : slabsLeft) left = kSlabs;
    parallelForWithScratch<BlockPainter>(
        kSlabs * blocks.size(), interrupter, [&](std::size_t i, BlockPainter& painter) {
            Block& block = blocks[i / kSlabs];
            if (block.full) return;
            drawSlab(block, int(i % kSlabs), balls, wanted, painter);
            if (--slabsLeft[i / kSlabs] == 0) std::vector<int32_t>().swap(block.balls);
        });
}

bool isEmpty(const Block& block)
{
    return !block.full && block.node->isChildMaskOff() && block.node->isValueMaskOff();
}

MaskTree::Ptr assemble(const RootCells& cells, std::vector<Block>& blocks)
{
    auto tree = std::make_shared<MaskTree>();
    for (const auto& [origin, cell] : cells) {
        if (cell.full) tree->root().addTile(origin, true, true);
    }
    RootCellNode* parent = nullptr; // blocks of a root cell stand together
    for (Block& block : blocks) {
        if (isEmpty(block)) continue;
        const Coord origin = block.origin & ~((1 << kRootCellLog2) - 1);
        if (!parent || parent->origin() != origin) {
            parent = new RootCellNode(origin, false, false);
            tree->root().addChild(parent);
        }
        if (block.full) {
            parent->addTile(RootCellNode::coordToOffset(block.origin), true, true);
        } else {
            parent->addChild(block.node.release());
        }
    }
    return tree;
}

} // namespace

MaskTree::Ptr rasterSpheres(const std::vector<ExactSphere>& spheres, const SphereMetric& metric,
    const openvdb::CoordBBox& clip, const MaskTree* within,
    openvdb::util::NullInterrupter* interrupter)
{
    const Wanted wanted(within);
    std::vector<Ball> balls = clipSpheres(spheres, metric, clip);
    sortLargerFirst(balls);
    const RootCells cells = sortIntoRootCells(balls, wanted, interrupter);
    std::vector<Block> blocks = sortIntoBlocks(cells, balls, wanted, interrupter);
    drawBlocks(blocks, balls, wanted, interrupter);
    return assemble(cells, blocks);
}

} // namespace detail
} // namespace openvdb_spheretree
