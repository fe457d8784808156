// SPDX-License-Identifier: Apache-2.0
#include "SphereBlocks.h"

#include "BallLists.h"
#include "BlockCanvas.h"
#include "MaskNodes.h"
#include "Parallel.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace openvdb_spheretree {
namespace detail {

namespace {

using openvdb::Coord;
using openvdb::MaskTree;
using openvdb::util::NullInterrupter;

/// So many balls are sorted in one go.
constexpr std::size_t kPart = 8192;

struct RootCell {
    bool full = false;
    std::vector<int32_t> balls;
};
using RootCells = std::map<Coord, RootCell>;

void enterRootCell(RootCell& cell, const Coord& origin, const Ball& ball, int32_t index)
{
    if (cell.full || !ball.touches(origin.data(), 1 << kRootCellLog2)) return;
    cell.full = ball.contains(origin.data(), 1 << kRootCellLog2);
    cell.balls.push_back(index);
}

void enterRootCells(RootCells& cells, const Ball& ball, int32_t index, const Wanted& wanted,
    NullInterrupter* interrupter)
{
    const openvdb::CoordBBox range(
        Coord(ball.lo) >> kRootCellLog2, Coord(ball.hi) >> kRootCellLog2);
    if (!wanted.everywhere() && range.volume() > wanted.rootCells().size()) {
        checkInterrupt(interrupter);
        for (const Coord& origin : wanted.rootCells()) {
            if (!range.isInside(origin >> kRootCellLog2)) continue;
            enterRootCell(cells[origin], origin, ball, index);
        }
        return;
    }
    int64_t visited = 0;
    for (auto at = range.begin(); at; ++at) {
        if (++visited % 4096 == 0) checkInterrupt(interrupter);
        const Coord origin = *at << kRootCellLog2;
        if (!wanted.hasRootCell(origin)) continue;
        enterRootCell(cells[origin], origin, ball, index);
    }
}

template <typename Element>
void append(std::vector<Element>& all, std::vector<Element> more)
{
    if (all.empty()) all = std::move(more);
    else all.insert(all.end(), more.begin(), more.end());
}

RootCells sortIntoRootCells(
    const ClippedSpheres& spheres, const Wanted& wanted, NullInterrupter* interrupter)
{
    const std::size_t count = spheres.order.size();
    std::vector<RootCells> parts((count + kPart - 1) / kPart);
    parallelFor(parts.size(), interrupter, [&](std::size_t part) {
        const std::size_t end = std::min((part + 1) * kPart, count);
        for (std::size_t i = part * kPart; i < end; ++i) {
            const int32_t index = spheres.order[i];
            enterRootCells(parts[part], spheres.balls[index], index, wanted, interrupter);
        }
    });
    RootCells cells;
    for (RootCells& part : parts) {
        for (auto& [origin, cell] : part) {
            RootCell& all = cells[origin];
            all.full = all.full || cell.full;
            if (!all.full) append(all.balls, std::move(cell.balls));
        }
    }
    return cells;
}

/// Some of the balls of a root cell.
struct PartOfCell {
    Coord origin;
    const int32_t *begin, *end;
};

std::vector<PartOfCell> partsOf(const RootCells& cells)
{
    std::vector<PartOfCell> parts;
    for (const auto& [origin, cell] : cells) {
        if (cell.full) continue;
        const int32_t* const end = cell.balls.data() + cell.balls.size();
        for (const int32_t* at = cell.balls.data(); at != end;) {
            const int32_t* const next = at + std::min(kPart, std::size_t(end - at));
            parts.push_back({origin, at, next});
            at = next;
        }
    }
    return parts;
}

/// @return the children of a root cell that balls reach into, in order.
std::vector<Block> blocksOf(const BallLists& lists, const Wanted& wanted)
{
    std::vector<Block> blocks;
    for (std::size_t child = 0; child < lists.size(); ++child) {
        if (!lists.full(child) && lists.begin(child) == lists.end(child)) continue;
        Block block;
        block.origin = lists.childOrigin(child);
        if (!wanted.has<BlockNode>(block.origin)) continue;
        block.full = lists.full(child);
        if (!block.full) block.balls.assign(lists.begin(child), lists.end(child));
        blocks.push_back(std::move(block));
    }
    return blocks;
}

/// Joins the blocks of parts of one cell, in the order of parts.
void joinBlocks(std::vector<Block>* first, std::vector<Block>* last, std::vector<Block>& result)
{
    std::map<Coord, Block> joined; // in the order of children: x slowest
    for (; first != last; ++first) {
        for (Block& block : *first) {
            Block& all = joined[block.origin];
            all.origin = block.origin;
            all.full = all.full || block.full;
            append(all.balls, std::move(block.balls));
        }
    }
    for (auto& [origin, block] : joined) {
        if (block.full) std::vector<int32_t>().swap(block.balls);
        result.push_back(std::move(block));
    }
}

} // namespace

Wanted::Wanted(const MaskTree* tree) : mTree(tree)
{
    if (!tree) return;
    for (auto i = tree->root().cbeginChildOn(); i; ++i) mRootCells.push_back(i.getCoord());
    for (auto i = tree->root().cbeginValueOn(); i; ++i) mRootCells.push_back(i.getCoord());
    std::sort(mRootCells.begin(), mRootCells.end());
}

bool Wanted::hasRootCell(const Coord& origin) const
{
    return everywhere() || std::binary_search(mRootCells.begin(), mRootCells.end(), origin);
}

ClippedSpheres clipSpheres(const std::vector<ExactSphere>& spheres, const SphereMetric& metric,
    const openvdb::CoordBBox& clip, NullInterrupter* interrupter)
{
    enum class Kind : char { Empty, Small, Large };
    const int shift = shiftOf(metric);
    ClippedSpheres result;
    result.balls = makeLargeArray<Ball>(spheres.size());
    std::vector<Kind> kinds(spheres.size());
    parallelFor(spheres.size(), interrupter, [&](std::size_t i) {
        Ball& ball = result.balls[i];
        if (!clippedBall(spheres[i], metric.distance, shift, clip, ball)) return;
        kinds[i] = BlockCanvas::isSmall(ball) ? Kind::Small : Kind::Large;
    });
    std::vector<int32_t>& order = result.order;
    order.reserve(spheres.size());
    const auto add = [&](Kind kind) {
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            if (kinds[i] == kind) order.push_back(int32_t(i));
        }
    };
    add(Kind::Large);
    tbb::parallel_sort(order.begin(), order.end(),
        [&](int32_t a, int32_t b) { return result.balls[a].coverSq > result.balls[b].coverSq; });
    add(Kind::Small);
    return result;
}

SphereBlocks sortIntoBlocks(
    const ClippedSpheres& spheres, const Wanted& wanted, NullInterrupter* interrupter)
{
    const RootCells cells = sortIntoRootCells(spheres, wanted, interrupter);
    const std::vector<PartOfCell> parts = partsOf(cells);
    std::vector<std::vector<Block>> blocks(parts.size());
    parallelForWithScratch<BallLists>(
        parts.size(), interrupter, [&](std::size_t i, BallLists& lists) {
            lists.build(spheres.balls.get(), parts[i].begin, parts[i].end, parts[i].origin,
                kRootCellLog2, BlockCanvas::kLog2);
            blocks[i] = blocksOf(lists, wanted);
        });
    SphereBlocks result;
    for (const auto& [origin, cell] : cells) {
        if (cell.full) result.fullRootCells.push_back(origin);
    }
    for (std::size_t i = 0, end = 0; i < parts.size(); i = end) {
        while (end < parts.size() && parts[end].origin == parts[i].origin) ++end;
        joinBlocks(blocks.data() + i, blocks.data() + end, result.blocks);
    }
    return result;
}

} // namespace detail
} // namespace openvdb_spheretree
