// SPDX-License-Identifier: Apache-2.0
#include "SlackMerging.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tight/fit/ExtremePoints.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// @return the most regions that have a part in the same leaf.
uint32_t mostInLeaf(const std::vector<VoxelRegion>& regions, std::size_t leaves)
{
    std::vector<uint32_t> counts(leaves, 0);
    for (const VoxelRegion& region : regions) {
        for (const RegionLeaf part : region) ++counts[part.leaf];
    }
    return counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
}

} // namespace

SlackMerging::SlackMerging(const SampledObject& object, const std::vector<CoverBall>& leafBalls,
    std::vector<VoxelRegion> regions, const FitEffort& effort, bool flat,
    openvdb::util::NullInterrupter* interrupter, bool areInside)
    : mObject(object), mVoxels(object.level(0)), mEffort(effort), mFlat(flat),
      mInterrupter(interrupter), mLeafBalls(int32_t(leafBalls.size())), mAreInside(areInside),
      mBalls(ballsOf(leafBalls)), mGroups(groupsOf(leafBalls)), mRegions(std::move(regions)),
      mCounts(mVoxels.leafCount(), mostInLeaf(mRegions, mVoxels.leafCount()))
{
    for (const VoxelRegion& region : mRegions) {
        for (const RegionLeaf part : region) mCounts.add(part.leaf, part.mask);
    }
    for (int32_t i = 0; i < mLeafBalls; ++i) {
        if (!isInside(i)) mMerged.add(i, mBalls[i]);
    }
}

MergeCandidate SlackMerging::evaluate(int32_t a, int32_t b) const
{
    thread_local CoveringFit fit;
    thread_local ExtremePoints points;
    points.clear(); // of the voxels that are in no region but those of the two nodes
    forEachLeafOfBoth(
        mRegions[a], mRegions[b], [&](uint32_t leaf, const LeafMask& inA, const LeafMask& inB) {
            const LeafMask both = inA & inB;
            const LeafMask uncovered =
                (mCounts.heldBy(leaf, 1) & ((inA | inB) - both)) | (mCounts.heldBy(leaf, 2) & both);
            if (!uncovered.none()) points.add(mVoxels.origin(leaf), uncovered);
        });
    const std::vector<openvdb::Coord>& targets = points.finish();
    if (targets.empty()) return {-1e300, a, b, ExactSphere(), 0}; // nothing is better than this

    fit.open(mObject, targets, {mBalls[a], mBalls[b]}, mEffort.samples);
    for (const int32_t other : mMerged.meeting(fit.box())) {
        if (other != a && other != b) fit.cover(mBalls[other]);
    }
    std::vector<ExactSphere> replaced;
    for (const int32_t node : {a, b}) {
        if (!isInside(node)) replaced.push_back(mBalls[node]);
    }
    const double freed = fit.costOf(replaced);
    const FittedBall fitted = fit.best(mEffort, mFlat);
    return {fitted.cost - freed, a, b, fitted.ball, 0};
}

void SlackMerging::merge(const std::vector<MergeCandidate>& merges, int32_t node)
{
    std::vector<VoxelRegion> regions(merges.size());
    detail::parallelFor(merges.size(), mInterrupter, [&](std::size_t i) {
        const MergeCandidate& c = merges[i];
        if (c.ball.empty()) return;
        regions[i] = clipped(unionOf(mRegions[c.a], mRegions[c.b]), c.ball, mVoxels);
    });
    for (std::size_t i = 0; i < merges.size(); ++i) {
        const MergeCandidate& c = merges[i];
        for (const int32_t child : {c.a, c.b}) {
            for (const RegionLeaf part : mRegions[child]) mCounts.remove(part.leaf, part.mask);
            mRegions[child] = VoxelRegion();
            if (!isInside(child)) mMerged.remove(child, mBalls[child]);
        }
        if (c.ball.empty()) continue;
        for (const RegionLeaf part : regions[i]) mCounts.add(part.leaf, part.mask);
        mRegions.push_back(std::move(regions[i]));
        mBalls.push_back(c.ball);
        mMerged.add(node + int32_t(i), c.ball);
    }
}

} // namespace openvdb_spheretree::tight
