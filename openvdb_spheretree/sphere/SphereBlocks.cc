// SPDX-License-Identifier: Apache-2.0
#include "SphereBlocks.h"

#include "BallLists.h"
#include "BlockCanvas.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/MaskNodes.h>

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

/// So many balls are sorted in one go: enough to be worth the lists of a cell's 32^3 children, and
/// few enough for these to be counted in 32 bits.
constexpr std::size_t kBallsAtATime = 8192;

struct RootCell {
    bool full = false;
    std::vector<int32_t> balls;
};
using RootCells = std::map<Coord, RootCell>;

void enterRootCell(RootCell& cell, const Coord& origin, const ClippedSphere& ball, int32_t index)
{
    if (cell.full || !ball.touches(origin.data(), 1 << kRootCellLog2)) return;
    cell.full = ball.contains(origin.data(), 1 << kRootCellLog2);
    cell.balls.push_back(index);
}

/// @param visited  cells so far, of this and other balls
void enterRootCells(RootCells& cells, const ClippedSphere& ball, int32_t index,
    const Wanted& wanted, int64_t& visited, NullInterrupter* interrupter)
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
    for (auto at = range.begin(); at; ++at) {
        if (++visited % 4096 == 0) checkInterrupt(interrupter);
        const Coord origin = *at << kRootCellLog2;
        if (!wanted.hasRootCell(origin)) continue;
        enterRootCell(cells[origin], origin, ball, index);
    }
}

/// Joins the balls of a cell, which do not matter once it is full.
void join(
    bool full, const int32_t* begin, const int32_t* end, bool& allFull, std::vector<int32_t>& all)
{
    allFull = allFull || full;
    if (allFull) std::vector<int32_t>().swap(all);
    else all.insert(all.end(), begin, end);
}

RootCells sortIntoRootCells(
    const ClippedSpheres& spheres, const Wanted& wanted, NullInterrupter* interrupter)
{
    const std::size_t count = spheres.order.size();
    std::vector<RootCells> parts((count + kBallsAtATime - 1) / kBallsAtATime);
    parallelFor(parts.size(), interrupter, [&](std::size_t part) {
        const std::size_t end = std::min((part + 1) * kBallsAtATime, count);
        int64_t visited = 0;
        for (std::size_t i = part * kBallsAtATime; i < end; ++i) {
            const int32_t index = spheres.order[i];
            enterRootCells(parts[part], spheres.balls[index], index, wanted, visited, interrupter);
        }
    });
    RootCells cells;
    for (RootCells& part : parts) {
        checkInterrupt(interrupter);
        for (auto& [origin, cell] : part) {
            RootCell& all = cells[origin];
            join(cell.full, cell.balls.data(), cell.balls.data() + cell.balls.size(), all.full,
                all.balls);
        }
        RootCells().swap(part);
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
            const int32_t* const next = at + std::min(kBallsAtATime, std::size_t(end - at));
            parts.push_back({origin, at, next});
            at = next;
        }
    }
    return parts;
}

/// The children of a root cell that some balls reach into, in order, and which balls these are.
struct Children {
    struct Child {
        Coord origin;
        bool full;
        std::size_t end; ///< of its balls; they begin where the last child's end
    };
    std::vector<Child> children;
    std::vector<int32_t> balls;
};

Children childrenOf(const BallLists& lists, const Wanted& wanted)
{
    Children result;
    for (std::size_t child = 0; child < lists.size(); ++child) {
        const bool full = lists.full(child);
        if (!full && lists.begin(child) == lists.end(child)) continue;
        const Coord origin = lists.childOrigin(child);
        if (!wanted.has<BlockNode>(origin)) continue;
        if (!full) result.balls.insert(result.balls.end(), lists.begin(child), lists.end(child));
        result.children.push_back({origin, full, result.balls.size()});
    }
    return result;
}

/// Joins what balls of one root cell reach into, in the order of balls. @a parts are used up.
void joinBlocks(Children* parts, Children* end, std::vector<Block>& result)
{
    std::map<Coord, Block> joined; // in the order of children: x slowest
    for (; parts != end; ++parts) {
        const Children part = std::move(*parts);
        const int32_t* begin = part.balls.data();
        for (const Children::Child& child : part.children) {
            Block& block = joined[child.origin];
            const int32_t* const last = part.balls.data() + child.end;
            join(child.full, begin, last, block.full, block.balls);
            begin = last;
        }
    }
    for (auto& [origin, block] : joined) {
        block.origin = origin;
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
    result.balls = makeLargeArray<ClippedSphere>(spheres.size());
    std::vector<Kind> kinds(spheres.size());
    parallelFor(spheres.size(), interrupter, [&](std::size_t i) {
        ClippedSphere& ball = result.balls[i];
        if (!clipSphere(spheres[i], metric.distance, shift, clip, ball)) return;
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
    tbb::parallel_sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
        const int64_t first = result.balls[a].radiusSq, second = result.balls[b].radiusSq;
        return first != second ? first > second : a < b;
    });
    add(Kind::Small);
    return result;
}

SphereBlocks sortIntoBlocks(
    const ClippedSpheres& spheres, const Wanted& wanted, NullInterrupter* interrupter)
{
    const RootCells cells = sortIntoRootCells(spheres, wanted, interrupter);
    const std::vector<PartOfCell> parts = partsOf(cells);
    std::vector<Children> children(parts.size());
    parallelForWithScratch<BallLists>(
        parts.size(), interrupter, [&](std::size_t i, BallLists& lists) {
            lists.build(spheres.balls.get(), parts[i].begin, parts[i].end, parts[i].origin,
                kRootCellLog2, BlockCanvas::kLog2);
            children[i] = childrenOf(lists, wanted);
        });
    SphereBlocks result;
    for (const auto& [origin, cell] : cells) {
        if (cell.full) result.fullRootCells.push_back(origin);
    }
    for (std::size_t i = 0, end = 0; i < parts.size(); i = end) {
        while (end < parts.size() && parts[end].origin == parts[i].origin) ++end;
        checkInterrupt(interrupter);
        joinBlocks(children.data() + i, children.data() + end, result.blocks);
    }
    return result;
}

} // namespace detail
} // namespace openvdb_spheretree
