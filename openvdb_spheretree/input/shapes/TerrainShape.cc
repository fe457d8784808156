// SPDX-License-Identifier: Apache-2.0
#include "TerrainShape.h"

#include <openvdb_spheretree/base/Parallel.h>

#include <algorithm>
#include <array>
#include <atomic>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

constexpr int kNodeDim = BoolLowerNode::DIM;
constexpr int kTop = HeightField::kHighest + TerrainShape::kThickness - 1;
static_assert(kTop < kNodeDim, "the sheet lies in one layer of nodes");

/// The first and the last voxel of a column.
struct Column {
    int bottom, top;
};

/// @return the columns of the node at x0, y0: 128 x + y is the index of one.
std::vector<Column> columnsOf(const HeightField& field, int x0, int y0)
{
    constexpr int kWindow = kNodeDim + 2; // a column wider on every side
    const std::vector<int> heights = field.heights(x0 - 1, y0 - 1, kWindow);
    std::vector<int> lowest(heights.size()); // of three along y; the ends of rows are not used
    for (std::size_t i = 1; i + 1 < heights.size(); ++i) {
        lowest[i] = std::min({heights[i - 1], heights[i], heights[i + 1]});
    }
    std::vector<Column> columns(std::size_t(kNodeDim) * kNodeDim);
    for (int x = 0; x < kNodeDim; ++x) {
        for (int y = 0; y < kNodeDim; ++y) {
            const int at = (x + 1) * kWindow + y + 1;
            columns[std::size_t(x * kNodeDim + y)] = {
                std::min({lowest[at - kWindow], lowest[at], lowest[at + kWindow]}),
                heights[at] + TerrainShape::kThickness - 1};
        }
    }
    return columns;
}

/// The leaves of a node that have one x and y.
using LeafPile = std::array<LeafMask, kNodeDim / kLeafDim>;

/// @param bit  of the voxel at z = 0 in word x of a leaf
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
    const int nodes = enough / kNodeDim + 1; // along a side

    // Voxels of the columns with max(x, y) = n, for every n.
    std::vector<std::atomic<int64_t>> rings(std::size_t(nodes) * kNodeDim);
    parallelFor(std::size_t(nodes) * std::size_t(nodes), interrupter, [&](std::size_t i) {
        const int x0 = int(i) / nodes * kNodeDim, y0 = int(i) % nodes * kNodeDim;
        const std::vector<Column> columns = columnsOf(mHeights, x0, y0);
        const int first = std::max(x0, y0); // a node has parts of 128 rings
        std::array<int64_t, kNodeDim> counts{};
        for (int n = 0; n < kNodeDim * kNodeDim; ++n) {
            const int ring = std::max(x0 + n / kNodeDim, y0 + n % kNodeDim);
            counts[ring - first] += columns[n].top - columns[n].bottom + 1;
        }
        for (int ring = 0; ring < kNodeDim; ++ring) rings[first + ring] += counts[ring];
    });
    int64_t count = 0;
    while (count + rings[mSide] / 2 < voxels) count += rings[mSide++];
}

CoordBBox TerrainShape::box() const { return {Coord(0), Coord(mSide - 1, mSide - 1, kTop)}; }

void TerrainShape::paint(BoolLowerNode& node) const
{
    const Coord origin = node.origin();
    const std::vector<Column> columns = columnsOf(mHeights, origin[0], origin[1]);
    const int endX = std::min(mSide - origin[0], kNodeDim);
    const int endY = std::min(mSide - origin[1], kNodeDim);
    for (int x0 = 0; x0 < endX; x0 += kLeafDim) {
        for (int y0 = 0; y0 < endY; y0 += kLeafDim) {
            LeafPile pile{};
            for (int x = x0; x < std::min(x0 + kLeafDim, endX); ++x) {
                for (int y = y0; y < std::min(y0 + kLeafDim, endY); ++y) {
                    addColumn(pile, columns[x * kNodeDim + y], x - x0, kLeafDim * (y - y0));
                }
            }
            for (int i = 0; i < int(pile.size()); ++i) {
                addLeaf(node, origin.offsetBy(x0, y0, i * kLeafDim), pile[i]);
            }
        }
    }
}

} // namespace openvdb_spheretree::detail
