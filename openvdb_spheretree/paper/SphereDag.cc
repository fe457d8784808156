// SPDX-License-Identifier: Apache-2.0
#include "SphereDag.h"

#include "RunLabels.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/medial/BallIndex.h>

#include <hwy/base.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace openvdb_spheretree {
namespace detail {
namespace {

using openvdb::Coord;

/// The ball that labels each voxel of the coarser level, by rank (medial/BallIndex.h), 4 bytes a
/// voxel.
struct VoxelBalls {
    const LeafLayout& layout;
    const BallIndex index;
    LargeArray<int32_t> ranks; ///< 512 a leaf; -1 where a voxel is off
    /// Voxels whose ball is not known to be that of the voxel before along x.
    std::vector<LeafMask> changed;
    /// Voxels whose ball is known to be that of the voxel before along y, or z.
    std::vector<LeafMask> likeBeforeY, likeBeforeZ;

    VoxelBalls(const MedialLevel& level, openvdb::util::NullInterrupter* interrupter)
        : layout(level.layout), index(layout, level.centers, interrupter),
          ranks(makeLargeArray<int32_t>(std::size_t(layout.leafCount()) * kLeafVoxels)),
          changed(layout.leafCount()), likeBeforeY(layout.leafCount()),
          likeBeforeZ(layout.leafCount())
    {
        parallelFor(layout.runCount(Axis::X), interrupter, [&](std::size_t i) {
            const LeafLayout::Run run = layout.run(Axis::X, uint32_t(i));
            RunLabels labels(level.labels, index, run);
            for (uint32_t place = 0; place < run.count; ++place) {
                labels.enterLeaf(place);
                fillLeaf(labels, place == 0 ? nullptr : ranksOf(run.leaves[place - 1]));
            }
        });
    }

    int32_t* ranksOf(uint32_t leaf) const { return ranks.get() + std::size_t(leaf) * kLeafVoxels; }

private:
    /// @param before  the ranks of the leaf before along x, if there is one
    void fillLeaf(RunLabels& labels, const int32_t* before)
    {
        const uint32_t leaf = labels.leaf();
        int32_t* here = ranksOf(leaf);
        std::fill_n(here, kLeafVoxels, -1);
        for (uint32_t x = 0; x < 8; ++x) {
            labels.enterWord(x);
            int32_t* row = here + 64 * x;
            for (uint64_t bits = labels.on(); bits; bits &= bits - 1) {
                const uint32_t lane = openvdb::util::FindLowestOn(bits);
                row[lane] = labels.rank(lane);
            }
            const int32_t* last = x > 0 ? row - 64 : before ? before + 7 * 64 : nullptr;
            changed[leaf][x] = last ? ~equalLanes(row, last) : ~uint64_t(0);
            const LikeBefore like = labels.likeBefore();
            likeBeforeY[leaf][x] = like.alongY;
            likeBeforeZ[leaf][x] = like.alongZ;
        }
    }
};

/// The parents, along one axis, of the eight coordinates in a leaf.
struct AxisParents {
    int count = 0;
    std::array<int32_t, 8> parent{};  ///< coordinates on the coarser level, ascending
    std::array<uint8_t, 8> placeOf{}; ///< where in `parent` that of each coordinate is

    AxisParents(const PyramidStep& step, const Coord& origin, int axis)
    {
        // One division a leaf, not one a voxel.
        const int64_t factor = axis < step.dim ? step.factor : 1;
        int32_t last = step.parentVoxel(origin)[axis];
        int64_t left = factor * (int64_t(last) + 1) - (int64_t(origin[axis]) - step.origin[axis]);
        parent[0] = last;
        for (int i = 0; i < kLeafDim; ++i, --left) {
            if (left == 0) {
                parent[++count] = ++last;
                left = factor;
            }
            placeOf[i] = uint8_t(count);
        }
        ++count;
    }

    /// 0 or 1: eight neighbours lie in two leaves at most.
    int leafOf(int place) const { return (parent[place] >> 3) - (parent[0] >> 3); }
};

/// The labels of the parents of a run of voxels, 64 voxels at a time: the bits of up to 64 parents
/// are spread over their children.
class RunParents {
public:
    /// @param first  origin of the run's first leaf; the others have the same y and z
    RunParents(const VoxelBalls& balls, const PyramidStep& step, const Coord& first)
        : mBalls(balls), mAlongY(step, first, 1), mAlongZ(step, first, 2)
    {
        for (uint32_t lane = 0; lane < 64; ++lane) {
            const int y = mAlongY.placeOf[lane >> 3], z = mAlongZ.placeOf[lane & 7];
            mLeafOf[lane] = uint8_t(2 * mAlongY.leafOf(y) + mAlongZ.leafOf(z));
            mIndexOf[lane] = uint16_t(8 * (mAlongY.parent[y] & 7) + (mAlongZ.parent[z] & 7));
            const bool innerY = lane >= 8 && mAlongY.placeOf[(lane >> 3) - 1] == y;
            const bool innerZ = (lane & 7) != 0 && mAlongZ.placeOf[(lane & 7) - 1] == z;
            mInnerY |= uint64_t(innerY) << lane;
            mInnerZ |= uint64_t(innerZ) << lane;
        }
        for (int y = 0; y < kLeafDim; ++y) mRows[mAlongY.placeOf[y]] |= uint64_t(1) << 8 * y;
        for (uint32_t bits = 0; bits < uint32_t(1) << mAlongZ.count; ++bits) {
            for (int z = 0; z < kLeafDim; ++z) {
                mColumns[bits] |= uint8_t((bits >> mAlongZ.placeOf[z] & 1) << z);
            }
        }
    }

    uint64_t on = 0; ///< voxels of the word whose parents are on
    /// Voxels whose parents may have another ball than those of the voxels before along x.
    uint64_t changed = 0;
    /// Voxels whose parents have the ball of the parent of the voxel before along y, or z.
    uint64_t likeBeforeY = 0, likeBeforeZ = 0;

    /// Moves to the parents of coordinate @a x. (Inlined into its caller it takes the edges' registers: all
    /// of the DAG takes 5 to 8% longer.)
    HWY_NOINLINE void moveTo(int32_t x)
    {
        if (mX == x) {
            changed = 0;
            return;
        }
        if (!mX || *mX >> 3 != x >> 3) {
            const int lastY = mAlongY.leafOf(mAlongY.count - 1);
            const int lastZ = mAlongZ.leafOf(mAlongZ.count - 1);
            for (int i = 0; i < 4; ++i) {
                const int y = i >> 1, z = i & 1;
                if (y > lastY || z > lastZ) continue;
                mLeaves[i] = mBalls.layout.findLeaf(
                    {x, mAlongY.parent[0] + kLeafDim * y, mAlongZ.parent[0] + kLeafDim * z});
            }
        }
        mX = x;
        on = spread(mBalls.layout.masks());
        changed = spread(mBalls.changed);
        likeBeforeY = mInnerY | spread(mBalls.likeBeforeY);
        likeBeforeZ = mInnerZ | spread(mBalls.likeBeforeZ);
    }

    /// The rank of the ball that labels the parent of the voxel at bit @a lane, where that is on.
    int32_t rank(uint32_t lane) const
    {
        const int32_t* ranks = mBalls.ranksOf(*mLeaves[mLeafOf[lane]]);
        return ranks[64 * uint32_t(*mX & 7) + mIndexOf[lane]];
    }

private:
    /// The bits of the parents, one row along z at a time, to bits of their children.
    /// @param masks  of all leaves
    uint64_t spread(const std::vector<LeafMask>& masks) const
    {
        std::array<uint64_t, 4> words;
        for (int i = 0; i < 4; ++i) words[i] = mLeaves[i] ? masks[*mLeaves[i]][*mX & 7] : 0;
        const uint32_t firstZ = uint32_t(mAlongZ.parent[0] & 7);
        const uint32_t used = (1u << mAlongZ.count) - 1;
        uint64_t result = 0;
        for (int y = 0; y < mAlongY.count; ++y) {
            const int pair = 2 * mAlongY.leafOf(y), shift = 8 * (mAlongY.parent[y] & 7);
            const uint32_t row = uint32_t(words[pair] >> shift & 0xff)
                | uint32_t(words[pair + 1] >> shift & 0xff) << 8;
            result |= mRows[y] * mColumns[row >> firstZ & used];
        }
        return result;
    }

    const VoxelBalls& mBalls;
    const AxisParents mAlongY, mAlongZ;
    std::array<uint64_t, 8> mRows{};     ///< per parent along y: bit 8 y of its children
    std::array<uint8_t, 256> mColumns{}; ///< bits of parents along z to bits of their children
    /// Voxels that share the parent of the one before along y, or z.
    uint64_t mInnerY = 0, mInnerZ = 0;
    std::array<uint8_t, 64> mLeafOf{};   ///< of mLeaves, for each voxel's parent
    std::array<uint16_t, 64> mIndexOf{}; ///< there, from the first voxel of equal x
    /// The leaves that lie side by side along y and z, where there are any.
    std::array<std::optional<uint32_t>, 4> mLeaves;
    std::optional<int32_t> mX;
};

/// Pairs of ranks (medial/BallIndex.h) in pieces, so that none of them moves as they become more.
struct FoundPiece {
    static constexpr std::size_t kSize = std::size_t(1) << 16;
    LargeArray<DagEdge> edges = makeLargeArray<DagEdge>(kSize);
    std::size_t count = 0;
};

/// What a thread has found. Most pairs that come again are dropped by a small table of the last
/// ones; without a branch, because which ones is hard to predict.
class FoundEdges {
public:
    /// Makes room for the pairs of a word.
    void reserveWord()
    {
        if (mPieces.empty() || mPieces.back().count + 64 > FoundPiece::kSize) {
            mPieces.emplace_back();
        }
    }
    void add(int32_t parent, int32_t child)
    {
        const uint64_t edge = uint64_t(uint32_t(parent)) << 32 | uint32_t(child);
        uint64_t& recent = mRecent[edge * kGoldenRatio >> (64 - kRecentBits)];
        FoundPiece& piece = mPieces.back();
        piece.edges[piece.count] = {parent, child};
        piece.count += recent != edge;
        recent = edge;
    }
    const std::vector<FoundPiece>& pieces() const { return mPieces; }

private:
    static constexpr uint64_t kGoldenRatio = 0x9e3779b97f4a7c15; ///< spreads keys over the table
    static constexpr int kRecentBits = 12;                       ///< 32 KiB
    std::vector<FoundPiece> mPieces;
    /// No edge has all bits on: ranks are not negative.
    std::vector<uint64_t> mRecent =
        std::vector<uint64_t>(std::size_t(1) << kRecentBits, ~uint64_t(0));
};

/// Adds the pair of labels of every voxel of a run, but for those that are the pair of the voxel
/// before along x, y or z.
void scanRun(RunLabels& labels, uint32_t leaves, const VoxelBalls& parentBalls,
    const PyramidStep& step, FoundEdges& found)
{
    const LeafLayout& layout = labels.layout();
    RunParents parents(parentBalls, step, layout.origin(labels.leaf()));
    for (uint32_t i = 0; i < leaves; ++i) {
        labels.enterLeaf(i);
        const AxisParents parentsX(step, layout.origin(labels.leaf()), 0);
        for (uint32_t x = 0; x < 8; ++x) {
            parents.moveTo(parentsX.parent[parentsX.placeOf[x]]);
            const uint64_t fresh = labels.enterWord(x);
            uint64_t bits = (fresh | (labels.on() & parents.changed)) & parents.on;
            if (!bits) continue;
            const LikeBefore like = labels.likeBefore();
            bits &= ~(like.alongY & parents.likeBeforeY);
            bits &= ~(like.alongZ & parents.likeBeforeZ);
            found.reserveWord();
            for (; bits; bits &= bits - 1) {
                const uint32_t lane = openvdb::util::FindLowestOn(bits);
                found.add(parents.rank(lane), labels.rank(lane));
            }
        }
    }
}

/// A stable sort of edges by key(edge), which is less than @a keys. (CompressedRows by parent, each row
/// sorted by itself: the DAG of dragon-512 and hairball-256 takes 9 to 11% longer on one thread.)
template <typename Key>
void countingSort(
    const DagEdge* begin, const DagEdge* end, std::size_t keys, const Key& key, DagEdge* sorted)
{
    std::vector<std::size_t> place(keys + 1, 0);
    for (auto edge = begin; edge != end; ++edge) ++place[std::size_t(key(*edge)) + 1];
    std::partial_sum(place.begin(), place.end(), place.begin());
    for (auto edge = begin; edge != end; ++edge) sorted[place[std::size_t(key(*edge))]++] = *edge;
}

} // namespace
} // namespace detail

std::vector<DagEdge> sphereDag(const MedialLevel& fine, const MedialLevel& coarse,
    const PyramidStep& step, openvdb::util::NullInterrupter* interrupter)
{
    using namespace detail;
    const VoxelBalls parents(coarse, interrupter);
    const BallIndex index(fine.layout, fine.centers, interrupter);
    tbb::enumerable_thread_specific<FoundEdges> found;
    parallelFor(fine.layout.runCount(Axis::X), interrupter, [&](std::size_t i) {
        const LeafLayout::Run run = fine.layout.run(Axis::X, uint32_t(i));
        RunLabels labels(fine.labels, index, run);
        scanRun(labels, run.count, parents, step, found.local());
    });

    // All that was found in one array, ranks made indices of balls.
    std::vector<std::pair<const FoundPiece*, std::size_t>> places;
    std::size_t count = 0;
    for (const FoundEdges& some : found) {
        for (const FoundPiece& piece : some.pieces()) {
            places.emplace_back(&piece, count);
            count += piece.count;
        }
    }
    const auto edges = makeLargeArray<DagEdge>(count);
    parallelFor(places.size(), interrupter, [&](std::size_t i) {
        const auto& [piece, place] = places[i];
        for (std::size_t k = 0; k < piece->count; ++k) {
            const DagEdge& edge = piece->edges[k];
            edges[place + k] = {parents.index.ballOf(edge.parent), index.ballOf(edge.child)};
        }
    });

    // Sorted by child, then by parent: both are small numbers, so that no two edges are compared.
    const auto byChild = makeLargeArray<DagEdge>(count);
    DagEdge *const begin = edges.get(), *const middle = byChild.get();
    countingSort(
        begin, begin + count, fine.balls.size(), [](auto& e) { return e.child; }, middle);
    countingSort(
        middle, middle + count, coarse.balls.size(), [](auto& e) { return e.parent; }, begin);
    return std::vector<DagEdge>(begin, std::unique(begin, begin + count));
}

} // namespace openvdb_spheretree
