// SPDX-License-Identifier: Apache-2.0
#include "SphereDag.h"

#include "ParentLabels.h"
#include "RunLabels.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/medial/BallIndex.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace openvdb_spheretree {

namespace {

using openvdb::util::NullInterrupter;

/// Pairs of ranks (medial/BallIndex.h) in pieces, so that none of them moves as they become more.
struct FoundPiece {
    static constexpr std::size_t kSize = std::size_t(1) << 16;
    detail::LargeArray<DagEdge> edges = detail::makeLargeArray<DagEdge>(kSize);
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

using ThreadEdges = tbb::enumerable_thread_specific<FoundEdges>;

/// Adds the pair of labels of every voxel of a run, but for those that are the pair of the voxel
/// before along x, y or z.
void scanRun(detail::RunLabels& labels, uint32_t leaves, const detail::VoxelBalls& parentBalls,
    const PyramidStep& step, FoundEdges& found)
{
    const LeafLayout& layout = labels.layout();
    detail::RunParents parents(parentBalls, step, layout.origin(labels.leaf()));
    for (uint32_t i = 0; i < leaves; ++i) {
        labels.enterLeaf(i);
        const detail::AxisParents parentsX(step, layout.origin(labels.leaf()), 0);
        for (uint32_t x = 0; x < 8; ++x) {
            parents.moveTo(parentsX.parent[parentsX.placeOf[x]]);
            const uint64_t fresh = labels.enterWord(x);
            uint64_t bits = (fresh | (labels.on() & parents.changed())) & parents.on();
            if (!bits) continue;
            const detail::LikeBefore like = labels.likeBefore();
            bits &= ~(like.alongY & parents.likeBeforeY());
            bits &= ~(like.alongZ & parents.likeBeforeZ());
            found.reserveWord();
            for (; bits; bits &= bits - 1) {
                const uint32_t lane = openvdb::util::FindLowestOn(bits);
                found.add(parents.rank(lane), labels.rank(lane));
            }
        }
    }
}

/// A stable sort of edges by key(edge), which is less than @a keys.
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

std::vector<DagEdge> sphereDag(const MedialLevel& fine, const MedialLevel& coarse,
    const PyramidStep& step, NullInterrupter* interrupter)
{
    const detail::VoxelBalls parents(coarse, interrupter);
    const detail::BallIndex index(fine.layout, fine.centers, interrupter);
    ThreadEdges found;
    detail::parallelFor(fine.layout.runCount(Axis::X), interrupter, [&](std::size_t i) {
        const LeafLayout::Run run = fine.layout.run(Axis::X, uint32_t(i));
        detail::RunLabels labels(fine.labels, index, run);
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
    const auto edges = detail::makeLargeArray<DagEdge>(count);
    detail::parallelFor(places.size(), interrupter, [&](std::size_t i) {
        const auto& [piece, place] = places[i];
        for (std::size_t k = 0; k < piece->count; ++k) {
            const DagEdge& edge = piece->edges[k];
            edges[place + k] = {parents.index().ballOf(edge.parent), index.ballOf(edge.child)};
        }
    });

    // Sorted by child, then by parent: both are small numbers, so that no two edges are compared.
    const auto byChild = detail::makeLargeArray<DagEdge>(count);
    DagEdge *const begin = edges.get(), *const middle = byChild.get();
    countingSort(
        begin, begin + count, fine.balls.size(), [](auto& e) { return e.child; }, middle);
    countingSort(
        middle, middle + count, coarse.balls.size(), [](auto& e) { return e.parent; }, begin);
    return std::vector<DagEdge>(begin, std::unique(begin, begin + count));
}

} // namespace openvdb_spheretree
