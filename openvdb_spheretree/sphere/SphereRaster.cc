// SPDX-License-Identifier: Apache-2.0
/// @file SphereRaster.cc
/// @brief Spheres to a sparse mask: sorted into cells, then drawn on mask words.
///
/// 1. clipSpheres: the spheres' boxes, clipped; empty ones dropped
/// 2. sortIntoBlocks: which spheres reach into which 4096^3 and 128^3 cell
/// 3. drawSlab, in parallel over quarters of 128^3 cells: see BlockPainter.h
///
/// A cell of 4096 or 128 wholly inside a single sphere (and the clip) becomes a tile and is not
/// descended; a leaf does when it is full. Clipping needs no step of its own, since every sphere's
/// box is clipped. Exact: integers throughout. OR does not depend on the order of spheres, hence
/// the result not on threads.

#include "SphereRaster.h"

#include "BlockPainter.h"
#include "SphereBlocks.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/MaskNodes.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

namespace openvdb_spheretree {
namespace detail {
namespace {

using openvdb::Coord;
using openvdb::MaskTree;

/// The voxels of blocks; null for those that are full.
using BlockNodes = std::vector<std::unique_ptr<BlockNode>>;

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

void drawSlab(const Block& block, int slab, const ClippedSphere* balls, const Wanted& wanted,
    BlockPainter& painter, BlockNode& node)
{
    BlockCanvas& canvas = painter.canvas;
    canvas.begin(block.origin, slab);
    excludeUnwanted(canvas, wanted);
    painter.draw(balls, block.balls);
    storeSlab(canvas, wanted, node);
    for (int cell = canvas.firstCell(); cell < canvas.endCell(); ++cell) canvas.clean(cell);
}

/// Lists of balls are given back as they are drawn.
BlockNodes drawBlocks(std::vector<Block>& blocks, const ClippedSphere* balls, const Wanted& wanted,
    openvdb::util::NullInterrupter* interrupter)
{
    constexpr std::size_t kSlabs = BlockCanvas::kSlabs;
    BlockNodes nodes(blocks.size());
    parallelFor(blocks.size(), interrupter, [&](std::size_t i) {
        if (!blocks[i].full) nodes[i] = std::make_unique<BlockNode>(blocks[i].origin, false, false);
    });
    std::vector<std::atomic<std::size_t>> slabsLeft(blocks.size()); // there may be many balls
    for (auto& left : slabsLeft) left = kSlabs;
    parallelForWithScratch<BlockPainter>(
        kSlabs * blocks.size(), interrupter, [&](std::size_t i, BlockPainter& painter) {
            Block& block = blocks[i / kSlabs];
            if (block.full) return;
            drawSlab(block, int(i % kSlabs), balls, wanted, painter, *nodes[i / kSlabs]);
            if (--slabsLeft[i / kSlabs] == 0) std::vector<int32_t>().swap(block.balls);
        });
    return nodes;
}

MaskTree::Ptr assemble(const SphereBlocks& cells, BlockNodes& nodes)
{
    auto tree = std::make_shared<MaskTree>();
    for (const Coord& origin : cells.fullRootCells) tree->root().addTile(origin, true, true);
    RootCellNode* parent = nullptr; // blocks of a root cell stand together
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Block& block = cells.blocks[i];
        if (!block.full && nodes[i]->isChildMaskOff() && nodes[i]->isValueMaskOff()) continue;
        const Coord origin = block.origin & ~((1 << kRootCellLog2) - 1);
        if (!parent || parent->origin() != origin) {
            parent = new RootCellNode(origin, false, false);
            tree->root().addChild(parent);
        }
        if (block.full) {
            parent->addTile(RootCellNode::coordToOffset(block.origin), true, true);
        } else {
            parent->addChild(nodes[i].release());
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
    const ClippedSpheres clipped = clipSpheres(spheres, metric, clip, interrupter);
    SphereBlocks cells = sortIntoBlocks(clipped, wanted, interrupter);
    BlockNodes nodes = drawBlocks(cells.blocks, clipped.balls.get(), wanted, interrupter);
    return assemble(cells, nodes);
}

} // namespace detail
} // namespace openvdb_spheretree
