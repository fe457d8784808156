// SPDX-License-Identifier: Apache-2.0
#include "VoxelRule.h"

#include <openvdb_spheretree/base/Parallel.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

namespace {

using openvdb::BoolTree;
using openvdb::Coord;
using openvdb::CoordBBox;

constexpr int kCellDim = BoolCellNode::DIM;
constexpr int kBlockDim = BoolBlockNode::DIM;

/// Calls f(cube) for all cubes of the grid of this side (a power of two) that meet the box, in the
/// order of their coordinates.
template <typename F>
void forEachCube(const CoordBBox& box, int side, const F& f)
{
    const Coord first = box.min() & ~(side - 1), &last = box.max();
    for (int x = first[0]; x <= last[0]; x += side) {
        for (int y = first[1]; y <= last[1]; y += side) {
            for (int z = first[2]; z <= last[2]; z += side) {
                f(CoordBBox::createCube(Coord(x, y, z), side));
            }
        }
    }
}

CoordBBox common(CoordBBox a, const CoordBBox& b)
{
    a.intersect(b);
    return a;
}

/// The eight coordinates along one axis that lie within the box, as bits.
uint64_t axisBits(int origin, int first, int last)
{
    const int from = std::clamp(first - origin, 0, kLeafDim);
    const int to = std::clamp(last + 1 - origin, 0, kLeafDim);
    return ((uint64_t(1) << to) - 1) & ~((uint64_t(1) << from) - 1);
}

LeafMask clipped(LeafMask mask, const Coord& origin, const CoordBBox& box)
{
    const auto bits = [&](int i) { return axisBits(origin[i], box.min()[i], box.max()[i]); };
    const uint64_t xs = bits(0), ys = bits(1), zs = bits(2);
    uint64_t plane = 0;
    for (int y = 0; y < kLeafDim; ++y) plane |= (ys >> y & 1 ? zs : 0) << (8 * y);
    for (int x = 0; x < kLeafDim; ++x) mask[x] &= xs >> x & 1 ? plane : 0;
    return mask;
}

/// @return the blocks to be painted; full nodes have become tiles of @a tree.
std::vector<Coord> tilesAndBlocks(
    const VoxelRule& shape, BoolTree& tree, openvdb::util::NullInterrupter* interrupter)
{
    constexpr openvdb::Index kRootTile = 3, kCellTile = 2; // levels, as OpenVDB counts them
    std::vector<Coord> blocks;
    forEachCube(shape.box(), kCellDim, [&](const CoordBBox& cell) {
        checkInterrupt(interrupter);
        const Filling inCell = shape.filling(cell);
        if (inCell == Filling::All) tree.addTile(kRootTile, cell.min(), true, true);
        if (inCell != Filling::Part) return;
        forEachCube(common(cell, shape.box()), kBlockDim, [&](const CoordBBox& block) {
            const Filling inBlock = shape.filling(block);
            if (inBlock == Filling::All) tree.addTile(kCellTile, block.min(), true, true);
            if (inBlock == Filling::Part) blocks.push_back(block.min());
        });
    });
    return blocks;
}

/// @return null where the block holds nothing.
std::unique_ptr<BoolBlockNode> paintedBlock(const VoxelRule& shape, const Coord& origin)
{
    auto block = std::make_unique<BoolBlockNode>(origin, false);
    shape.paint(*block);
    if (block->isInactive() && block->leafCount() == 0) block.reset();
    return block;
}

void hang(BoolTree& tree, std::unique_ptr<BoolBlockNode> block)
{
    auto* cell = tree.probeNode<BoolCellNode>(block->origin());
    if (!cell) {
        cell = new BoolCellNode(block->origin(), false);
        tree.root().addChild(cell);
    }
    cell->addChild(block.release());
}

} // namespace

Filling VoxelRule::filling(const CoordBBox&) const { return Filling::Part; }

void LeafwiseRule::paint(BoolBlockNode& block) const
{
    constexpr openvdb::Index kBlockTile = 1;
    const CoordBBox bounds = box();
    const CoordBBox cubes = common(CoordBBox::createCube(block.origin(), kBlockDim), bounds);
    forEachCube(cubes, kLeafDim, [&](const CoordBBox& cube) {
        const Filling inLeaf = filling(cube);
        if (inLeaf == Filling::All) block.addTile(kBlockTile, cube.min(), true, true);
        if (inLeaf != Filling::Part) return;
        addLeaf(block, cube.min(), clipped(leaf(cube.min()), cube.min(), bounds));
    });
}

void addLeaf(BoolBlockNode& block, const Coord& origin, const LeafMask& mask)
{
    if (std::all_of(mask.begin(), mask.end(), [](uint64_t word) { return word == 0; })) return;
    auto leaf = std::make_unique<BoolLeafNode>(origin, false);
    BoolLeafNode::NodeMaskType bits;
    for (int word = 0; word < kLeafDim; ++word) {
        bits.getWord<uint64_t>(openvdb::Index(word)) = mask[word];
        leaf->buffer().data()[word] = mask[word]; // values are bits as well
    }
    leaf->setValueMask(bits);
    block.addLeaf(leaf.release());
}

BoolTree::Ptr treeOf(const VoxelRule& shape, openvdb::util::NullInterrupter* interrupter)
{
    const auto tree = std::make_shared<BoolTree>(false);
    const std::vector<Coord> blocks = tilesAndBlocks(shape, *tree, interrupter);
    std::vector<std::unique_ptr<BoolBlockNode>> nodes(blocks.size());
    parallelFor(blocks.size(), interrupter,
        [&](std::size_t i) { nodes[i] = paintedBlock(shape, blocks[i]); });
    for (auto& node : nodes) {
        if (node) hang(*tree, std::move(node));
    }
    return tree;
}

} // namespace detail
} // namespace openvdb_spheretree
