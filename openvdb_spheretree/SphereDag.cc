// SPDX-License-Identifier: Apache-2.0
#include "SphereDag.h"

#include "detail/BallIndex.h"
#include "detail/Parallel.h"
#include "detail/ParentLabels.h"
#include "detail/RunLabels.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace openvdb_spheretree {

namespace {

using openvdb::util::NullInterrupter;

/// What a thread has found. Most pairs that come again are dropped by a small table of the last
/// ones; without a branch, because which ones is hard to predict (15 -> 6 ns a pair).
class FoundEdges {
public:
    /// Makes room for the pairs of a word.
    void reserveWord()
    {
        if (mCount + 64 > mEdges.size()) mEdges.resize(2 * mEdges.size() + 1024);
    }
    void add(int32_t parent, int32_t child)
    {
        const uint64_t edge = uint64_t(uint32_t(parent)) << 32 | uint32_t(child);
        uint64_t& recent = mRecent[edge * kGoldenRatio >> (64 - kRecentBits)];
        mEdges[mCount] = {parent, child};
        mCount += recent != edge;
        recent = edge;
    }
    const DagEdge* begin() const { return mEdges.data(); }
    const DagEdge* end() const { return mEdges.data() + mCount; }

private:
    static constexpr uint64_t kGoldenRatio = 0x9e3779b97f4a7c15; ///< spreads keys over the table
    static constexpr int kRecentBits = 12;                       ///< 32 KiB
    std::vector<DagEdge> mEdges;
    std::size_t mCount = 0;
    /// No edge has all bits on: indices are not negative.
    std::vector<uint64_t> mRecent =
        std::vector<uint64_t>(std::size_t(1) << kRecentBits, ~uint64_t(0));
};

using ThreadEdges = tbb::enumerable_thread_specific<FoundEdges>;

/// Adds the pair of labels of every voxel of a run, but for those that are the pair of the voxel
/// before along x or z.
void scanRun(detail::RunLabels& labels, uint32_t leaves, const detail::VoxelBalls& parentBalls,
    const PyramidStep& step, FoundEdges& found)
{
    const LeafLayout& layout = labels.layout();
    detail::RunParents parents(parentBalls, step, layout.origin(labels.leaf()));
    for (uint32_t i = 0; i < leaves; ++i) {
        labels.enterLeaf(i);
        const detail::ParentCells cells(step, layout.origin(labels.leaf()), 0);
        for (uint32_t x = 0; x < 8; ++x) {
            parents.moveTo(cells.parent[cells.cellOf[x]]);
            const uint64_t fresh = labels.enterWord(x);
            uint64_t bits = (fresh | (labels.on() & parents.changed())) & parents.on();
            bits &= ~(labels.likeBeforeY() & parents.likeBeforeY());
            bits &= ~(labels.likeBeforeZ() & parents.likeBeforeZ());
            found.reserveWord();
            for (; bits; bits &= bits - 1) {
                const uint32_t lane = openvdb::util::FindLowestOn(bits);
                found.add(parents.ball(lane), labels.ball(lane));
            }
        }
    }
}

using EdgeRange = std::pair<const DagEdge*, const DagEdge*>;

/// A stable sort of all edges of @a ranges by key(edge), which is less than @a keys.
template <typename Key>
void countingSort(
    const std::vector<EdgeRange>& ranges, std::size_t keys, const Key& key, DagEdge* sorted)
{
    std::vector<std::size_t> place(keys + 1, 0);
    for (const EdgeRange& range : ranges) {
        for (auto edge = range.first; edge != range.second; ++edge) ++place[key(*edge) + 1];
    }
    std::partial_sum(place.begin(), place.end(), place.begin());
    for (const EdgeRange& range : ranges) {
        for (auto edge = range.first; edge != range.second; ++edge) {
            sorted[place[key(*edge)]++] = *edge;
        }
    }
}

/// By child, then by parent: both are small numbers, so that no two edges are ever compared.
std::vector<DagEdge> sortedEdges(
    const ThreadEdges& found, std::size_t parentCount, std::size_t childCount)
{
    std::vector<EdgeRange> ranges;
    std::size_t count = 0;
    for (const FoundEdges& some : found) {
        ranges.emplace_back(some.begin(), some.end());
        count += std::size_t(some.end() - some.begin());
    }
    std::vector<DagEdge> byChild(count), edges(count);
    const auto child = [](const DagEdge& edge) { return std::size_t(edge.child); };
    const auto parent = [](const DagEdge& edge) { return std::size_t(edge.parent); };
    countingSort(ranges, childCount, child, byChild.data());
    countingSort({{byChild.data(), byChild.data() + count}}, parentCount, parent, edges.data());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

} // namespace

std::vector<DagEdge> sphereDag(const MedialLevel& fine, const MedialLevel& coarse,
    const PyramidStep& step, NullInterrupter* interrupter)
{
    const detail::VoxelBalls parents(coarse, interrupter);
    const detail::BallIndex index(fine.layout, fine.balls, interrupter);
    ThreadEdges found;
    detail::parallelFor(fine.layout.runCount(Axis::X), interrupter, [&](std::size_t i) {
        const LeafLayout::Run run = fine.layout.run(Axis::X, uint32_t(i));
        detail::RunLabels labels(fine.labels, index, run);
        scanRun(labels, run.count, parents, step, found.local());
    });
    return sortedEdges(found, coarse.balls.size(), fine.balls.size());
}

} // namespace openvdb_spheretree
