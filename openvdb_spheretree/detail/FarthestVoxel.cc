// SPDX-License-Identifier: Apache-2.0
/// @file detail/FarthestVoxel.cc
/// @brief Branch and bound over cells of voxels, with one best distance B for all threads.
///
/// 1. Seed B: exact distances of one voxel each of a sample of cells, then the best cell in full.
/// 2. Every cell, in parallel. A box of voxels with centre c and half diagonal r is dismissed when
///    an object voxel lies within B - r of c, for then no voxel of the box is farther than B.
///    Otherwise it is split in eight, each part shrunk to the box of its voxels, down to single
///    ones, whose exact distance may raise B.
///
/// The order decides how much is dismissed, not the result: a maximum. Distances are doubled and
/// squared integers; the one place with rounding, B - r, is rounded down, which dismisses less.

#include "FarthestVoxel.h"

#include "Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace openvdb_spheretree {
namespace detail {
namespace {

using openvdb::Coord;

struct CellBox {
    int32_t lo[3], hi[3]; // inclusive
};

class FarthestSearch {
public:
    explicit FarthestSearch(const NearestVoxel& object) : mObject(object) {}

    int64_t bestSq2() const { return mBestSq2.load(std::memory_order_relaxed); }

    /// Raises B to the distance of a voxel. @return that distance, or anything up to B.
    int64_t visitVoxel(const Coord& voxel)
    {
        const int64_t point2[3] = {
            2 * int64_t(voxel[0]), 2 * int64_t(voxel[1]), 2 * int64_t(voxel[2])};
        int64_t best = bestSq2();
        const int64_t sq2 = mObject.distSq(point2, best);
        while (sq2 > best && !mBestSq2.compare_exchange_weak(best, sq2)) {}
        return sq2;
    }

    void visit(const VoxelCell& cell)
    {
        if (cell.size > 8) {
            visitTile(cell.origin, cell.size);
        } else {
            visitLeafPart(cell, {{0, 0, 0}, {7, 7, 7}}, 8);
        }
    }

private:
    /// @return whether no voxel of the box can be farther than B.
    bool dismissed(const CellBox& box) const
    {
        int64_t center2[3], side[3];
        for (int a = 0; a < 3; ++a) {
            side[a] = int64_t(box.hi[a]) - box.lo[a];
            center2[a] = int64_t(box.lo[a]) + box.hi[a];
        }
        const int64_t diagonalSq = mObject.distance().lengthSq(side[0], side[1], side[2]);
        constexpr double kLess = 1 - 1e-12; // by more than all that the roots may be off
        const double reach =
            std::sqrt(double(bestSq2())) * kLess - std::sqrt(double(diagonalSq)) / kLess;
        if (reach < 0) return false;
        return mObject.anyWithin(center2, int64_t(reach * reach * kLess));
    }

    /// Recursion: from 4096 to 8 in nine halvings.
    void visitTile(const Coord& origin, int32_t size)
    {
        if (size == 8) {
            VoxelCell cell;
            cell.origin = origin;
            std::fill(cell.words, cell.words + 8, ~uint64_t(0));
            visit(cell);
            return;
        }
        const Coord last = origin.offsetBy(size - 1);
        if (dismissed({{origin[0], origin[1], origin[2]}, {last[0], last[1], last[2]}})) return;
        const int32_t half = size / 2;
        for (int i = 0; i < 8; ++i) {
            visitTile(origin.offsetBy(i & 4 ? half : 0, i & 2 ? half : 0, i & 1 ? half : 0), half);
        }
    }

    /// @return false if none of the cell's voxels is in the box; otherwise the box is shrunk to
    /// them.
    static bool shrink(const VoxelCell& cell, CellBox& box)
    {
        const int32_t first = box.lo[0], last = box.hi[0];
        uint64_t rows = 0; // of z, wherever they are in x
        const uint64_t window = yzWindow(box);
        for (int32_t x = first, found = false; x <= last; ++x) {
            const uint64_t word = cell.words[x] & window;
            if (!word) continue;
            if (!found) box.lo[0] = x;
            box.hi[0] = x;
            found = true;
            rows |= word;
        }
        if (!rows) return false;
        box.lo[1] = int32_t(openvdb::util::FindLowestOn(openvdb::Index64(rows))) >> 3;
        while (!(rows >> (8 * box.hi[1]) & 0xff)) --box.hi[1];
        uint64_t row = rows | rows >> 32;
        row |= row >> 16;
        row |= row >> 8;
        while (!(row >> box.lo[2] & 1)) ++box.lo[2];
        while (!(row >> box.hi[2] & 1)) --box.hi[2];
        return true;
    }

    static uint64_t yzWindow(const CellBox& box)
    {
        const uint64_t row = (0xffu >> (7 - box.hi[2])) & (0xffu << box.lo[2]);
        uint64_t window = 0;
        for (int32_t y = box.lo[1]; y <= box.hi[1]; ++y) window |= row << (8 * y);
        return window;
    }

    /// @param box   a cube of @a size in the leaf, in local coordinates
    /// Recursion: from 8 to 1 in three halvings.
    void visitLeafPart(const VoxelCell& cell, const CellBox& cube, int32_t size)
    {
        CellBox box = cube;
        if (!shrink(cell, box)) return;
        const Coord lo = cell.origin.offsetBy(box.lo[0], box.lo[1], box.lo[2]);
        const Coord hi = cell.origin.offsetBy(box.hi[0], box.hi[1], box.hi[2]);
        if (lo == hi) {
            visitVoxel(lo);
            return;
        }
        if (dismissed({{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}})) return;
        const int32_t half = size / 2;
        for (int i = 0; i < 8; ++i) {
            CellBox part;
            for (int a = 0; a < 3; ++a) {
                part.lo[a] = cube.lo[a] + (i >> (2 - a) & 1 ? half : 0);
                part.hi[a] = part.lo[a] + half - 1;
            }
            visitLeafPart(cell, part, half);
        }
    }

    const NearestVoxel& mObject;
    std::atomic<int64_t> mBestSq2{0};
};

void seed(FarthestSearch& search, const std::vector<VoxelCell>& cells)
{
    constexpr std::size_t kSamples = 512;
    const std::size_t step = cells.size() / kSamples + 1;
    std::size_t best = 0;
    for (std::size_t i = 0; i < cells.size(); i += step) {
        const int64_t before = search.bestSq2();
        if (search.visitVoxel(cells[i].first()) > before) best = i;
    }
    search.visit(cells[best]);
}

} // namespace

int64_t farthestDistSq(const std::vector<VoxelCell>& cells, const NearestVoxel& object,
    openvdb::util::NullInterrupter* interrupter)
{
    if (cells.empty()) return 0;
    FarthestSearch search(object);
    seed(search, cells);
    parallelFor(cells.size(), interrupter, [&](std::size_t i) { search.visit(cells[i]); });
    return search.bestSq2() / 4;
}

} // namespace detail
} // namespace openvdb_spheretree
