// SPDX-License-Identifier: Apache-2.0
/// @file detail/MaskDifference.cc
/// @brief Difference of two masks: leaf words against leaf words, tiles against whatever is there.
///
/// Parallel over the 128^3 nodes of the first mask, each into its own slot; its larger tiles are
/// few and come last.

#include "MaskDifference.h"

#include "MaskNodes.h"
#include "Parallel.h"

#include <openvdb/tools/Count.h>

namespace openvdb_spheretree {
namespace detail {
namespace {

using openvdb::Coord;
using openvdb::MaskTree;

constexpr uint64_t kAllOn = ~uint64_t(0);

void append(MaskDifference& result, const VoxelCell& cell)
{
    const int64_t voxels = cell.voxels();
    if (voxels == 0) return;
    result.voxels += voxels;
    result.cells.push_back(cell);
}

VoxelCell tileCell(const Coord& origin, int32_t size)
{
    VoxelCell cell;
    cell.origin = origin;
    cell.size = size;
    std::fill(cell.words, cell.words + 8, kAllOn);
    return cell;
}

/// The words of a block's n-th leaf, of a tile likewise.
void leafWords(const BlockNode& block, openvdb::Index n, uint64_t words[8])
{
    if (block.isChildMaskOn(n)) {
        const auto& mask = block.getTable()[n].getChild()->getValueMask();
        for (int x = 0; x < 8; ++x) words[x] = mask.getWord<uint64_t>(x);
    } else {
        std::fill(words, words + 8, block.isValueMaskOn(n) ? kAllOn : 0);
    }
}

/// A 128^3 node minus what the other mask has there.
void subtractBlock(const BlockNode& a, const MaskTree& b, MaskDifference& result)
{
    const BlockNode* other = b.probeConstNode<BlockNode>(a.origin());
    if (!other && b.isValueOn(a.origin())) return; // a tile over all of it
    for (openvdb::Index n = 0; n < BlockNode::NUM_VALUES; ++n) {
        if (!a.isChildMaskOn(n) && !a.isValueMaskOn(n)) continue;
        VoxelCell cell;
        cell.origin = a.offsetToGlobalCoord(n);
        leafWords(a, n, cell.words);
        if (other) {
            uint64_t words[8];
            leafWords(*other, n, words);
            for (int x = 0; x < 8; ++x) cell.words[x] &= ~words[x];
        }
        append(result, cell);
    }
}

/// A tile of 128^3 minus what the other mask has there.
void subtractBlockTile(const Coord& origin, const MaskTree& b, MaskDifference& result)
{
    const BlockNode* other = b.probeConstNode<BlockNode>(origin);
    if (!other) {
        if (!b.isValueOn(origin)) append(result, tileCell(origin, BlockNode::DIM));
        return;
    }
    for (openvdb::Index n = 0; n < BlockNode::NUM_VALUES; ++n) {
        VoxelCell cell;
        cell.origin = other->offsetToGlobalCoord(n);
        leafWords(*other, n, cell.words);
        for (uint64_t& word : cell.words) word = ~word;
        append(result, cell);
    }
}

/// A tile of 4096^3 minus what the other mask has there.
void subtractRootTile(const Coord& origin, const MaskTree& b, MaskDifference& result)
{
    const RootCellNode* other = b.probeConstNode<RootCellNode>(origin);
    if (!other) {
        if (!b.isValueOn(origin)) append(result, tileCell(origin, RootCellNode::DIM));
        return;
    }
    for (openvdb::Index n = 0; n < RootCellNode::NUM_VALUES; ++n) {
        subtractBlockTile(other->offsetToGlobalCoord(n), b, result);
    }
}

void join(MaskDifference& result, std::vector<MaskDifference>& parts)
{
    std::size_t count = 0;
    for (const MaskDifference& part : parts) count += part.cells.size();
    result.cells.reserve(count);
    for (MaskDifference& part : parts) {
        result.voxels += part.voxels;
        result.cells.insert(result.cells.end(), part.cells.begin(), part.cells.end());
        part.cells = {};
    }
}

} // namespace

int64_t VoxelCell::voxels() const
{
    if (size > 8) return int64_t(size) * size * size;
    int64_t count = 0;
    for (uint64_t word : words) count += openvdb::util::CountOn(openvdb::Index64(word));
    return count;
}

Coord VoxelCell::first() const
{
    for (int x = 0; x < 8 && size == 8; ++x) {
        if (!words[x]) continue;
        const int bit = int(openvdb::util::FindLowestOn(openvdb::Index64(words[x])));
        return origin.offsetBy(x, bit >> 3, bit & 7);
    }
    return origin;
}

MaskDifference maskDifference(
    const MaskTree& a, const MaskTree& b, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<const BlockNode*> blocks;
    std::vector<Coord> blockTiles;
    for (auto cell = a.root().cbeginChildOn(); cell; ++cell) {
        for (auto block = cell->cbeginChildOn(); block; ++block) blocks.push_back(&*block);
        for (auto tile = cell->cbeginValueOn(); tile; ++tile) blockTiles.push_back(tile.getCoord());
    }
    std::vector<MaskDifference> parts(blocks.size() + 1);
    parallelFor(
        blocks.size(), interrupter, [&](std::size_t i) { subtractBlock(*blocks[i], b, parts[i]); });
    for (const Coord& origin : blockTiles) subtractBlockTile(origin, b, parts.back());
    for (auto tile = a.root().cbeginValueOn(); tile; ++tile) {
        subtractRootTile(tile.getCoord(), b, parts.back());
    }
    MaskDifference result;
    join(result, parts);
    return result;
}

MaskTree maskOf(const openvdb::BoolTree& tree)
{
    return MaskTree(tree, false, true, openvdb::TopologyCopy());
}

int64_t countVoxels(const MaskTree& tree)
{
    return int64_t(openvdb::tools::countActiveVoxels(tree));
}

} // namespace detail
} // namespace openvdb_spheretree
