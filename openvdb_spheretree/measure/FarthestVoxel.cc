// SPDX-License-Identifier: Apache-2.0
/// @file FarthestVoxel.cc
/// @brief Branch and bound over cells of voxels, with one best distance B for all threads.
///
/// A box of voxels with centre c and half diagonal r is dismissed when an object voxel lies within
/// B - r of c, for then no voxel of the box is farther than B.
///
/// 1. seed: exact distances of some samples, then the cell of the best one in full.
/// 2. Every node, in parallel (NodeSearch): its cells, sorted along a Morton curve, so that those of
///    any cube stand together. The cube's box is dismissed, or split in eight, down to single cells.
///    In those, voxels within B are taken off by words (LeafReach.h), which decides where B is a few
///    voxels. Of what is left, one voxel at a time has its exact distance taken, which may raise B,
///    and all go that are within B of the object voxel nearest to it. Tiles are split likewise.
///
/// The order decides how much is dismissed, not the result: a maximum. Distances are doubled and
/// squared integers; the one place with rounding, B - r, is rounded down, which dismisses less.

#include "FarthestVoxel.h"

#include "LeafReach.h"
#include <openvdb_spheretree/base/AtomicExtremes.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/sphere/BallWords.h>

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

/// A cell of eight, and its place in its block of 128.
struct PlacedCell {
    const VoxelCell* cell;
    uint32_t morton; ///< of 12 bits

    /// @return which eighth of a cube of @a size it is in.
    uint32_t partOf(int32_t size) const
    {
        const uint32_t half = uint32_t(size) / 16; // in leaves
        return morton / (half * half * half) & 7;
    }
};

class FarthestSearch {
public:
    FarthestSearch(const openvdb::MaskTree& mask, const NearestVoxel& object)
        : mMask(mask), mObject(object)
    {}

    int64_t bestSq2() const { return mBestSq2.load(std::memory_order_relaxed); }

    /// Raises B to the distance of a voxel. @return that distance, or anything up to B.
    int64_t visitVoxel(const Coord& voxel)
    {
        const int64_t point2[3] = {
            2 * int64_t(voxel[0]), 2 * int64_t(voxel[1]), 2 * int64_t(voxel[2])};
        const int64_t sq2 = mObject.distSq(point2, bestSq2());
        raiseTo(mBestSq2, sq2);
        return sq2;
    }

    void visit(const VoxelCell& cell, LeafReach& reach)
    {
        if (cell.size > 8) {
            visitTile(cell.origin, cell.size, reach);
        } else {
            visitLeaf(cell, reach);
        }
    }

    /// Visits cells of eight that are in one cube of @a size, sorted by their places.
    /// Recursion: from 128 to 8 in four halvings.
    void visitGroup(const PlacedCell* begin, const PlacedCell* end, int32_t size, LeafReach& reach)
    {
        if (end - begin == 1 || size == 8) {
            for (; begin != end; ++begin) visit(*begin->cell, reach);
            return;
        }
        if (dismissed(boxOf(begin, end))) return;
        while (begin != end) {
            const uint32_t part = begin->partOf(size);
            const PlacedCell* const first = begin;
            while (begin != end && begin->partOf(size) == part) ++begin;
            visitGroup(first, begin, size / 2, reach);
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

    void visitLeaf(VoxelCell cell, LeafReach& reach)
    {
        const Coord& lo = cell.origin;
        if (dismissed({{lo[0], lo[1], lo[2]}, {lo[0] + 7, lo[1] + 7, lo[2] + 7}})) return;
        reach.takeNear(mMask, mObject.distance(), bestSq2() / 4, cell);
        visitVoxels(cell);
    }

    static CellBox boxOf(const PlacedCell* begin, const PlacedCell* end)
    {
        CellBox box{{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
        for (; begin != end; ++begin) {
            for (int a = 0; a < 3; ++a) {
                box.lo[a] = std::min(box.lo[a], begin->cell->origin[a]);
                box.hi[a] = std::max(box.hi[a], begin->cell->origin[a] + 7);
            }
        }
        return box;
    }

    /// Recursion: from 4096 to 8 in nine halvings.
    void visitTile(const Coord& origin, int32_t size, LeafReach& reach)
    {
        if (size == 8) {
            VoxelCell cell;
            cell.origin = origin;
            std::fill(cell.words, cell.words + 8, ~uint64_t(0));
            visitLeaf(cell, reach);
            return;
        }
        const Coord last = origin.offsetBy(size - 1);
        if (dismissed({{origin[0], origin[1], origin[2]}, {last[0], last[1], last[2]}})) return;
        const int32_t half = size / 2;
        for (int i = 0; i < 8; ++i) {
            const Coord corner(i & 4 ? half : 0, i & 2 ? half : 0, i & 1 ? half : 0);
            visitTile(origin + corner, half, reach);
        }
    }

    /// Visits voxels until none is left, each with all that are within B of the object voxel that
    /// is nearest to it: that settles a patch of them, where one after the other would take a
    /// question each.
    void visitVoxels(VoxelCell& cell)
    {
        while (!isEmpty(cell)) {
            const Coord voxel = cell.first();
            Coord nearest;
            raiseTo(mBestSq2, mObject.nearest(voxel, nearest));
            const Coord at = voxel - cell.origin;
            cell.words[at[0]] &= ~(uint64_t(1) << (8 * at[1] + at[2])); // however far it is
            takeWithin(nearest, cell);
        }
    }

    static bool isEmpty(const VoxelCell& cell)
    {
        return std::all_of(cell.words, cell.words + 8, [](uint64_t word) { return word == 0; });
    }

    /// Takes off the voxels within B of an object voxel.
    void takeWithin(const Coord& voxel, VoxelCell& cell) const
    {
        ClippedSphere ball;
        for (int a = 0; a < 3; ++a) {
            ball.center[a] = 2 * int64_t(voxel[a]);
            ball.lo[a] = INT32_MIN;
            ball.hi[a] = INT32_MAX;
        }
        ball.radiusSq = bestSq2();
        ball.distance = mObject.distance();
        ball.clipped = ball.plain = false;
        ball.shift = 1; // doubled coordinates
        uint64_t within[8] = {};
        orBallIntoWords(ball, cell.origin, within);
        for (int x = 0; x < 8; ++x) cell.words[x] &= ~within[x];
    }

    const openvdb::MaskTree& mMask;
    const NearestVoxel& mObject; ///< the same, as an index
    std::atomic<int64_t> mBestSq2{0};
};

/// Bits x, y, z of a place in a block, from the highest: three of Morton's code at a time.
uint32_t mortonOf(const Coord& origin)
{
    uint32_t code = 0;
    for (int bit = 6; bit >= 3; --bit) {
        for (int a = 0; a < 3; ++a) code = code << 1 | (uint32_t(origin[a]) >> bit & 1);
    }
    return code;
}

/// Visits nodes of a set. Memory of one thread.
class NodeSearch {
public:
    void visit(FarthestSearch& search, const MaskMinus& set, std::size_t node)
    {
        set.cells(node, mCells);
        for (std::size_t begin = 0, end; begin < mCells.size(); begin = end) {
            end = endOfBlock(begin);
            if (mCells[begin].size > 8) {
                search.visit(mCells[begin], mReach);
                continue;
            }
            sort(begin, end);
            search.visitGroup(mPlaced.data(), mPlaced.data() + mPlaced.size(), 128, mReach);
        }
    }

    /// Visits the cell of a sample alone.
    void visit(FarthestSearch& search, const MaskMinus& set, const VoxelCount::Sample& sample)
    {
        set.cells(sample.node, mCells);
        const auto cell = std::find_if(mCells.begin(), mCells.end(),
            [&](const VoxelCell& c) { return c.origin == (sample.voxel & ~(c.size - 1)); });
        search.visit(*cell, mReach);
    }

private:
    /// @return behind the cells of eight that are in one block of 128; or behind one larger cell.
    std::size_t endOfBlock(std::size_t begin) const
    {
        const auto blockOf = [](const VoxelCell& cell) { return cell.origin & ~127; };
        std::size_t end = begin + 1;
        if (mCells[begin].size > 8) return end;
        while (end < mCells.size() && mCells[end].size == 8
            && blockOf(mCells[end]) == blockOf(mCells[begin])) {
            ++end;
        }
        return end;
    }

    void sort(std::size_t begin, std::size_t end)
    {
        mAt.assign(kPlaces, nullptr);
        for (std::size_t i = begin; i < end; ++i) mAt[mortonOf(mCells[i].origin)] = &mCells[i];
        mPlaced.clear();
        for (uint32_t place = 0; place < kPlaces; ++place) {
            if (mAt[place]) mPlaced.push_back({mAt[place], place});
        }
    }

    static constexpr uint32_t kPlaces = 16 * 16 * 16;
    std::vector<VoxelCell> mCells;
    std::vector<const VoxelCell*> mAt; ///< by place
    std::vector<PlacedCell> mPlaced;
    LeafReach mReach;
};

void seed(
    FarthestSearch& search, const MaskMinus& set, const std::vector<VoxelCount::Sample>& samples)
{
    constexpr std::size_t kSamples = 512;
    const std::size_t step = samples.size() / kSamples + 1;
    std::size_t best = 0;
    for (std::size_t i = 0; i < samples.size(); i += step) {
        const int64_t before = search.bestSq2();
        if (search.visitVoxel(samples[i].voxel) > before) best = i;
    }
    NodeSearch().visit(search, set, samples[best]);
}

/// Counts nodes. Memory of one thread.
class NodeCount {
public:
    void count(const MaskMinus& set, std::size_t node, VoxelCount& result)
    {
        set.cells(node, mCells);
        uint32_t seen = 0; // eighths
        for (const VoxelCell& cell : mCells) {
            result.voxels += cell.voxels();
            const uint32_t eighth = 1u << (mortonOf(cell.origin) >> 9);
            if (!(seen & eighth)) result.samples.push_back({node, cell.first()});
            seen |= eighth;
        }
    }

private:
    std::vector<VoxelCell> mCells;
};

} // namespace

VoxelCount countVoxels(const MaskMinus& set, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<VoxelCount> counts(set.nodeCount());
    parallelForWithScratch<NodeCount>(counts.size(), interrupter,
        [&](std::size_t node, NodeCount& scratch) { scratch.count(set, node, counts[node]); });
    VoxelCount all;
    for (const VoxelCount& count : counts) {
        all.voxels += count.voxels;
        all.samples.insert(all.samples.end(), count.samples.begin(), count.samples.end());
    }
    return all;
}

int64_t farthestDistSq(const MaskMinus& set, const std::vector<VoxelCount::Sample>& samples,
    const openvdb::MaskTree& mask, const NearestVoxel& object,
    openvdb::util::NullInterrupter* interrupter)
{
    if (samples.empty()) return 0;
    FarthestSearch search(mask, object);
    seed(search, set, samples);
    parallelForWithScratch<NodeSearch>(set.nodeCount(), interrupter,
        [&](std::size_t node, NodeSearch& scratch) { scratch.visit(search, set, node); });
    return search.bestSq2() / 4;
}

} // namespace detail
} // namespace openvdb_spheretree
