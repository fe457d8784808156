// SPDX-License-Identifier: Apache-2.0
#include "TerrainShape.h"

#include <openvdb_spheretree/base/Parallel.h>

#include <algorithm>
#include <array>
#include <atomic>

namespace openvdb_spheretree {
namespace detail {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

constexpr int kBlockDim = BoolBlockNode::DIM;
constexpr int kTop = HeightField::kHighest + TerrainShape::kThickness - 1;
static_assert(kTop < kBlockDim, "the sheet lies in one layer of blocks");

/// The first and the last voxel of a column.
struct Column {
    int bottom, top;
    int voxels() const { return top - bottom + 1; }
};

/// Those of a block, at 128 x + y.
using Columns = std::vector<Column>;

Columns columnsOf(const HeightField& field, int x0, int y0)
{
    constexpr int kWindow = kBlockDim + 2; // a column wider on every side
    const std::vector<int> heights = field.heights(x0 - 1, y0 - 1, kWindow);
    std::vector<int> lowest(heights.size()); // of three along y; nobody asks at a row's ends
    for (std::size_t i = 1; i + 1 < heights.size(); ++i) {
        lowest[i] = std::min({heights[i - 1], heights[i], heights[i + 1]});
    }
    Columns columns(std::size_t(kBlockDim) * kBlockDim);
    for (int x = 0; x < kBlockDim; ++x) {
        for (int y = 0; y < kBlockDim; ++y) {
            const int at = (x + 1) * kWindow + y + 1;
            columns[std::size_t(x * kBlockDim + y)] = {
                std::min({lowest[at - kWindow], lowest[at], lowest[at + kWindow]}),
                heights[at] + TerrainShape::kThickness - 1};
        }
    }
    return columns;
}

/// Voxels of the columns with max(x, y) = n, for every n below @a side.
std::vector<std::atomic<int64_t>> ringCounts(
    const HeightField& field, int side, openvdb::util::NullInterrupter* interrupter)
{
    const int blocks = (side + kBlockDim - 1) / kBlockDim;
    std::vector<std::atomic<int64_t>> rings(std::size_t(blocks) * kBlockDim);
    parallelFor(std::size_t(blocks) * std::size_t(blocks), interrupter, [&](std::size_t i) {
        const int x0 = int(i) / blocks * kBlockDim, y0 = int(i) % blocks * kBlockDim;
        const Columns columns = columnsOf(field, x0, y0);
        const int first = std::max(x0, y0); // all rings of a block are among 128
        std::array<int64_t, kBlockDim> counts{};
        for (int n = 0; n < kBlockDim * kBlockDim; ++n) {
            const int ring = std::max(x0 + n / kBlockDim, y0 + n % kBlockDim);
            counts[ring - first] += columns[n].voxels();
        }
        for (int ring = 0; ring < kBlockDim; ++ring) rings[first + ring] += counts[ring];
    });
    return rings;
}

/// The leaves above one another of a block.
using LeafPile = std::array<LeafMask, kBlockDim / kLeafDim>;

/// @param bit  of the column's voxels in a leaf's word x, for z = 0
void addColumn(LeafPile& pile, const Column& column, int x, int bit)
{
    for (int leaf = column.bottom / kLeafDim; leaf <= column.top / kLeafDim; ++leaf) {
        const int from = std::max(column.bottom - leaf * kLeafDim, 0);
        const int to = std::min(column.top - leaf * kLeafDim, kLeafDim - 1);
        pile[leaf][x] |= ((uint64_t(2) << to) - (uint64_t(1) << from)) << bit;
    }
}

} // namespace

TerrainShape::TerrainShape(
    int64_t voxels, uint64_t seed, openvdb::util::NullInterrupter* interrupter)
    : mHeights(seed)
{
    int enough = 1; // as a side, since no column is thinner
    while (int64_t(enough) * enough * kThickness < voxels) enough += 1 + enough / 64;
    const auto rings = ringCounts(mHeights, enough + 1, interrupter);
    int64_t count = 0;
    while (count + rings[mSide] / 2 < voxels) count += rings[mSide++];
}

CoordBBox TerrainShape::box() const { return {Coord(0), Coord(mSide - 1, mSide - 1, kTop)}; }

void TerrainShape::paint(BoolBlockNode& block) const
{
    const Coord origin = block.origin();
    const Columns columns = columnsOf(mHeights, origin[0], origin[1]);
    const int endX = std::min(mSide - origin[0], kBlockDim);
    const int endY = std::min(mSide - origin[1], kBlockDim);
    for (int x0 = 0; x0 < endX; x0 += kLeafDim) {
        for (int y0 = 0; y0 < endY; y0 += kLeafDim) {
            LeafPile pile{};
            for (int x = x0; x < std::min(x0 + kLeafDim, endX); ++x) {
                for (int y = y0; y < std::min(y0 + kLeafDim, endY); ++y) {
                    addColumn(pile, columns[x * kBlockDim + y], x - x0, kLeafDim * (y - y0));
                }
            }
            for (int i = 0; i < int(pile.size()); ++i) {
                addLeaf(block, origin.offsetBy(x0, y0, i * kLeafDim), pile[i]);
            }
        }
    }
}

} // namespace detail
} // namespace openvdb_spheretree
