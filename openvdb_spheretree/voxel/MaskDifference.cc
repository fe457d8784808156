// SPDX-License-Identifier: Apache-2.0
/// @file MaskDifference.cc
/// @brief Difference of two masks: leaf words against leaf words, tiles against whatever is there.
///
/// The 128^3 nodes of the first mask come first; its larger tiles are few, and come last.

#include "MaskDifference.h"

#include "MaskNodes.h"
#include <openvdb_spheretree/base/Parallel.h>

#include <openvdb/tools/Count.h>

namespace openvdb_spheretree {
namespace detail {
namespace {

using openvdb::Coord;
using openvdb::MaskTree;

constexpr uint64_t kAllOn = ~uint64_t(0);

bool isEmpty(const VoxelCell& cell)
{
    uint64_t any = 0;
    for (const uint64_t word : cell.words) any |= word;
    return any == 0;
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
void subtractBlock(const BlockNode& a, const MaskTree& b, std::vector<VoxelCell>& result)
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
        if (!isEmpty(cell)) result.push_back(cell);
    }
}

/// A tile of 128^3 minus what the other mask has there.
void subtractBlockTile(const Coord& origin, const MaskTree& b, std::vector<VoxelCell>& result)
{
    const BlockNode* other = b.probeConstNode<BlockNode>(origin);
    if (!other) {
        if (!b.isValueOn(origin)) result.push_back(tileCell(origin, BlockNode::DIM));
        return;
    }
    for (openvdb::Index n = 0; n < BlockNode::NUM_VALUES; ++n) {
        VoxelCell cell;
        cell.origin = other->offsetToGlobalCoord(n);
        leafWords(*other, n, cell.words);
        for (uint64_t& word : cell.words) word = ~word;
        if (!isEmpty(cell)) result.push_back(cell);
    }
}

/// A tile of 4096^3 minus what the other mask has there.
void subtractRootTile(const Coord& origin, const MaskTree& b, std::vector<VoxelCell>& result)
{
    const RootCellNode* other = b.probeConstNode<RootCellNode>(origin);
    if (!other) {
        if (!b.isValueOn(origin)) result.push_back(tileCell(origin, RootCellNode::DIM));
        return;
    }
    for (openvdb::Index n = 0; n < RootCellNode::NUM_VALUES; ++n) {
        subtractBlockTile(other->offsetToGlobalCoord(n), b, result);
    }
}

} // namespace

int64_t VoxelCell::voxels() const
{
    if (size > 8) return int64_t(size) * size * size;
    uint64_t all = kAllOn;
    for (const uint64_t word : words) all &= word;
    if (all == kAllOn) return 512;
    int64_t count = 0;
    for (const uint64_t word : words) count += openvdb::util::CountOn(openvdb::Index64(word));
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

MaskMinus::MaskMinus(const MaskTree& a, const MaskTree& b) : mA(a), mB(b)
{
    constexpr int32_t kBlock = BlockNode::DIM;
    std::vector<Node> tiles;
    for (auto cell = a.root().cbeginChildOn(); cell; ++cell) {
        for (auto block = cell->cbeginChildOn(); block; ++block) {
            mNodes.push_back({block->origin(), kBlock, false});
        }
        for (auto tile = cell->cbeginValueOn(); tile; ++tile) {
            tiles.push_back({tile.getCoord(), kBlock, true});
        }
    }
    mNodes.insert(mNodes.end(), tiles.begin(), tiles.end());
    for (auto tile = a.root().cbeginValueOn(); tile; ++tile) {
        mNodes.push_back({tile.getCoord(), int32_t(RootCellNode::DIM), true});
    }
}

void MaskMinus::cells(std::size_t index, std::vector<VoxelCell>& result) const
{
    result.clear();
    const Node& node = mNodes[index];
    if (!node.tile) {
        subtractBlock(*mA.probeConstNode<BlockNode>(node.origin), mB, result);
    } else if (node.size == int32_t(BlockNode::DIM)) {
        subtractBlockTile(node.origin, mB, result);
    } else {
        subtractRootTile(node.origin, mB, result);
    }
}

MaskDifference maskDifference(
    const MaskTree& a, const MaskTree& b, openvdb::util::NullInterrupter* interrupter)
{
    const MaskMinus minus(a, b);
    std::vector<std::vector<VoxelCell>> parts(minus.nodeCount());
    parallelFor(
        parts.size(), interrupter, [&](std::size_t node) { minus.cells(node, parts[node]); });
    MaskDifference result;
    std::size_t count = 0;
    for (const auto& part : parts) count += part.size();
    result.cells.reserve(count);
    for (auto& part : parts) {
        for (const VoxelCell& cell : part) result.voxels += cell.voxels();
        result.cells.insert(result.cells.end(), part.begin(), part.end());
        part = {};
    }
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
