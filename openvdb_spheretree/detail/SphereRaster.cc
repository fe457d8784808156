// SPDX-License-Identifier: Apache-2.0
/// @file detail/SphereRaster.cc
/// @brief Spheres to a sparse mask: sorted into ever smaller cells, then drawn row by row.
///
/// 1. clipSpheres: the spheres' boxes, clipped; empty ones dropped
/// 2. sortIntoRootCells, sortIntoBlocks: which spheres reach into which 4096^3 and 128^3 cell
/// 3. drawBlock, in parallel over 128^3 cells: the same from 128 to 32 to 8 (class Lists)
/// 4. drawLeaf: rows of z from an integer square root, OR-ed into mask words
///
/// A cell wholly inside a single sphere (and the clip) becomes a tile and is not descended. Clipping
/// needs no step of its own, since every sphere's box is clipped. Exact: integers throughout. OR does
/// not depend on the order of spheres, hence the result not on threads.

#include "SphereRaster.h"

#include "ExactBall.h"
#include "Parallel.h"

#include <map>
#include <memory>

namespace openvdb_spheretree {
namespace detail {
namespace {

using openvdb::Coord;
using openvdb::MaskTree;
using RootCellNode = MaskTree::RootNodeType::ChildNodeType; // 4096^3
using BlockNode = RootCellNode::ChildNodeType;              // 128^3
using LeafNode = MaskTree::LeafNodeType;                    // 8^3

constexpr int kRootCellLog2 = 12, kBlockLog2 = 7, kCellLog2 = 5, kLeafLog2 = 3;

/// The spheres that reach into each child of a cell, as one array with offsets. Reused, as building
/// these lists is most of the work for small spheres.
class Lists {
public:
    /// @param origin, log2    the cell
    /// @param childLog2       its children's size; children are numbered x slowest, as in OpenVDB
    void build(const std::vector<Ball>& balls, const int32_t* begin, const int32_t* end,
        const Coord& origin, int log2, int childLog2)
    {
        mOrigin = origin;
        mLog2 = log2;
        mChildLog2 = childLog2;
        const std::size_t count = std::size_t(1) << (3 * (log2 - childLog2));
        mFull.assign(count, 0);
        mOffset.assign(count + 1, 0);
        mEntries.clear();
        for (const int32_t* i = begin; i != end; ++i) enter(balls[*i], *i);
        for (std::size_t c = 0; c < count; ++c) mOffset[c + 1] += mOffset[c];
        mItems.resize(mEntries.size());
        for (auto e = mEntries.rbegin(); e != mEntries.rend(); ++e) {
            mItems[--mOffset[e->child + 1]] = e->ball;
        }
        // Each offset was moved to the front of its own child's items: one place to the left of
        // where it is read.
        mOffset.push_back(int32_t(mItems.size()));
    }
    std::size_t size() const { return mFull.size(); }
    bool full(std::size_t child) const { return mFull[child]; }
    const int32_t* begin(std::size_t child) const { return mItems.data() + mOffset[child + 1]; }
    const int32_t* end(std::size_t child) const { return mItems.data() + mOffset[child + 2]; }
    Coord childOrigin(std::size_t child) const
    {
        const int n = mLog2 - mChildLog2, mask = (1 << n) - 1, c = int(child);
        const Coord at(c >> (2 * n), (c >> n) & mask, c & mask);
        return mOrigin.offsetBy(at[0] << mChildLog2, at[1] << mChildLog2, at[2] << mChildLog2);
    }

private:
    struct Entry {
        int32_t child, ball;
    };

    void enter(const Ball& ball, int32_t index)
    {
        int32_t first[3], last[3]; // of the children under the ball's box
        const int32_t size = int32_t(1) << mLog2;
        for (int a = 0; a < 3; ++a) {
            first[a] = (std::max(ball.lo[a], mOrigin[a]) - mOrigin[a]) >> mChildLog2;
            last[a] = (std::min(ball.hi[a], mOrigin[a] + (size - 1)) - mOrigin[a]) >> mChildLog2;
        }
        for (int32_t x = first[0]; x <= last[0]; ++x) {
            for (int32_t y = first[1]; y <= last[1]; ++y) {
                for (int32_t z = first[2]; z <= last[2]; ++z) enterChild(ball, index, x, y, z);
            }
        }
    }
    void enterChild(const Ball& ball, int32_t index, int32_t x, int32_t y, int32_t z)
    {
        const int n = mLog2 - mChildLog2;
        const int32_t child = (((x << n) | y) << n) | z, size = int32_t(1) << mChildLog2;
        if (mFull[child]) return;
        const int32_t origin[3] = {mOrigin[0] + (x << mChildLog2), mOrigin[1] + (y << mChildLog2),
            mOrigin[2] + (z << mChildLog2)};
        if (!ball.touches(origin, size)) return;
        if (ball.contains(origin, size)) {
            mFull[child] = 1;
            return;
        }
        mEntries.push_back({child, index});
        ++mOffset[child + 1];
    }

    Coord mOrigin;
    int mLog2 = 0, mChildLog2 = 0;
    std::vector<char> mFull;
    std::vector<int32_t> mOffset, mItems;
    std::vector<Entry> mEntries;
};

/// A 128^3 cell to be drawn.
struct Block {
    Coord origin;
    bool full = false;
    std::vector<int32_t> balls;
    std::unique_ptr<BlockNode> node; ///< stays null if the block turns out empty
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

std::vector<Ball> clipSpheres(
    const std::vector<ExactSphere>& spheres, const openvdb::CoordBBox& clip)
{
    std::vector<Ball> balls(spheres.size());
    std::vector<char> kept(spheres.size());
    parallelFor(spheres.size(), nullptr,
        [&](std::size_t i) { kept[i] = clippedBall(spheres[i], clip, balls[i]); });
    std::size_t count = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (kept[i]) balls[count++] = balls[i];
    }
    balls.resize(count);
    return balls;
}

/// Largest first: they fill cells and leaves that the others then need not enter.
void sortBySize(std::vector<Ball>& balls)
{
    const auto larger = [](const Ball& a, const Ball& b) { return a.coverSq > b.coverSq; };
    std::stable_sort(balls.begin(), balls.end(), larger);
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
        for (auto at = range.begin(); at; ++at) {
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
    Lists lists;
    for (const auto& [origin, cell] : cells) {
        checkInterrupt(interrupter);
        if (cell.full) continue;
        lists.build(balls, cell.balls.data(), cell.balls.data() + cell.balls.size(), origin,
            kRootCellLog2, kBlockLog2);
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

/// ORs the rows of one sphere into the words of a leaf: word x, bit 8 y + z.
void drawRows(const Ball& ball, const Coord& origin, uint64_t words[8])
{
    int32_t first[3], last[3];
    for (int a = 0; a < 3; ++a) {
        first[a] = std::max(ball.lo[a], origin[a]) - origin[a];
        last[a] = std::min(ball.hi[a], origin[a] + 7) - origin[a];
    }
    for (int32_t x = first[0]; x <= last[0]; ++x) {
        if (words[x] == ~uint64_t(0)) continue;
        const int64_t leftX =
            takeSquare(ball.coverSq, 2 * (int64_t(origin[0]) + x) - ball.center2[0]);
        if (leftX < 0) continue;
        for (int32_t y = first[1]; y <= last[1]; ++y) {
            const int64_t left = takeSquare(leftX, 2 * (int64_t(origin[1]) + y) - ball.center2[1]);
            if (left < 0) continue;
            const Interval run(ball.center2[2] - 2 * int64_t(origin[2]), floorSqrt(left));
            const auto lo = std::max<int64_t>(run.lo, first[2]);
            const auto hi = std::min<int64_t>(run.hi, last[2]);
            if (lo > hi) continue;
            words[x] |= uint64_t((0xff >> (7 - hi)) & (0xff << lo)) << (8 * y);
        }
    }
}

/// @return the leaf, or null if no voxel is in a sphere after all.
std::unique_ptr<LeafNode> drawLeaf(
    const std::vector<Ball>& balls, const int32_t* begin, const int32_t* end, const Coord& origin)
{
    uint64_t words[8] = {};
    const auto isFull = [&] {
        uint64_t all = ~uint64_t(0);
        for (uint64_t word : words) all &= word;
        return all == ~uint64_t(0);
    };
    for (const int32_t* i = begin; i != end && !isFull(); ++i) drawRows(balls[*i], origin, words);
    uint64_t any = 0;
    for (uint64_t word : words) any |= word;
    if (!any) return nullptr;
    auto leaf = std::make_unique<LeafNode>(origin);
    for (int x = 0; x < 8; ++x) leaf->getValueMask().getWord<uint64_t>(x) = words[x];
    return leaf;
}

struct BlockScratch {
    Lists cells, leaves;
};

/// A block under construction: its node is made with the first thing to put in it.
class BlockPen {
public:
    BlockPen(Block& block, const Wanted& wanted) : mBlock(block), mWanted(wanted) {}
    void tile(const Coord& origin)
    {
        if (!mWanted.has<LeafNode>(origin)) return;
        node().addTile(BlockNode::coordToOffset(origin), true, true);
    }
    void leaf(const std::vector<Ball>& balls, const int32_t* begin, const int32_t* end,
        const Coord& origin)
    {
        if (begin == end || !mWanted.has<LeafNode>(origin)) return;
        if (auto leaf = drawLeaf(balls, begin, end, origin)) node().addLeaf(leaf.release());
    }

private:
    BlockNode& node()
    {
        if (!mBlock.node) mBlock.node = std::make_unique<BlockNode>(mBlock.origin, false, false);
        return *mBlock.node;
    }
    Block& mBlock;
    const Wanted& mWanted;
};

void drawBlock(
    Block& block, const std::vector<Ball>& balls, const Wanted& wanted, BlockScratch& scratch)
{
    if (block.full) return;
    BlockPen pen(block, wanted);
    Lists& cells = scratch.cells;
    Lists& leaves = scratch.leaves;
    const int32_t* all = block.balls.data();
    cells.build(balls, all, all + block.balls.size(), block.origin, kBlockLog2, kCellLog2);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        if (!cells.full(c) && cells.begin(c) == cells.end(c)) continue;
        const int32_t* begin = cells.full(c) ? cells.end(c) : cells.begin(c);
        leaves.build(balls, begin, cells.end(c), cells.childOrigin(c), kCellLog2, kLeafLog2);
        for (std::size_t l = 0; l < leaves.size(); ++l) {
            const Coord origin = leaves.childOrigin(l);
            if (cells.full(c) || leaves.full(l)) {
                pen.tile(origin);
            } else {
                pen.leaf(balls, leaves.begin(l), leaves.end(l), origin);
            }
        }
    }
    block.balls = {}; // no longer needed, and there may be many
}

MaskTree::Ptr assemble(const RootCells& cells, std::vector<Block>& blocks)
{
    auto tree = std::make_shared<MaskTree>();
    for (const auto& [origin, cell] : cells) {
        if (cell.full) tree->root().addTile(origin, true, true);
    }
    RootCellNode* parent = nullptr; // blocks of a root cell stand together
    for (Block& block : blocks) {
        if (!block.full && !block.node) continue;
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

MaskTree::Ptr rasterSpheres(const std::vector<ExactSphere>& spheres,
    const openvdb::CoordBBox& clip, const MaskTree* within,
    openvdb::util::NullInterrupter* interrupter)
{
    const Wanted wanted(within);
    std::vector<Ball> balls = clipSpheres(spheres, clip);
    sortBySize(balls);
    const RootCells cells = sortIntoRootCells(balls, wanted, interrupter);
    std::vector<Block> blocks = sortIntoBlocks(cells, balls, wanted, interrupter);
    parallelForWithScratch<BlockScratch>(blocks.size(), interrupter,
        [&](std::size_t i, BlockScratch& scratch) {
            drawBlock(blocks[i], balls, wanted, scratch);
        });
    return assemble(cells, blocks);
}

} // namespace detail
} // namespace openvdb_spheretree
