// SPDX-License-Identifier: Apache-2.0
/// @file SlackMerging.h
/// @brief Merging with slack (quality=normal and best): a ball owes only what no other ball of the
/// cover holds, and costs only what no other one costs already.
///
/// Each node has a region, the object voxels that it answers for: a leaf, its ball's; a merged node,
/// those of its children's regions that its ball holds. A new node must hold what its children's
/// regions alone have, and that is often little: where balls overlap, the others have it. Regions
/// of a cut cover the object, and a voxel of a node's region is in one of its children's, so there
/// is a chain of balls from every cut down to the leaves (the contract of DESIGN 10). A node never
/// changes after its merge: every cut is valid.

#pragma once

#include "CoverBall.h"
#include "MergeForest.h"
#include <openvdb_spheretree/tight/fit/BallFit.h>
#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/tight/region/CoverCounts.h>
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include <vector>

namespace openvdb_spheretree {
namespace tight {

class SlackMerging : public MergeModel {
public:
    /// @param leaves  inside the object
    /// @param regions  of the leaves, in their balls; they cover the object
    /// @param flat    centres keep their z
    SlackMerging(const SampledObject& object, const std::vector<CoverBall>& leaves,
        std::vector<VoxelRegion> regions, const FitEffort& effort, bool flat,
        openvdb::util::NullInterrupter* interrupter);

    std::vector<FineBall> leaves() const override
    {
        return {mBalls.begin(), mBalls.begin() + mLeafCount};
    }
    int32_t groupOf(int32_t leaf) const override { return mGroups[leaf]; }
    MergeCandidate evaluate(int32_t a, int32_t b) const override;
    void merge(const std::vector<MergeCandidate>& merges, int32_t node) override;
    bool dependsOnOthers() const override { return true; }

private:
    /// Only what is not a leaf holds anything outside the object.
    bool isLeaf(int32_t node) const { return node < mLeafCount; }
    void collectDebt(int32_t a, int32_t b, class ExtremePoints& points) const;
    void forget(int32_t node);

    const SampledObject& mObject;
    const SampleLevel& mVoxels;
    FitEffort mEffort;
    bool mFlat;
    openvdb::util::NullInterrupter* mInterrupter;
    int32_t mLeafCount;
    std::vector<FineBall> mBalls;
    std::vector<int32_t> mGroups;      ///< of leaves
    std::vector<VoxelRegion> mRegions; ///< of living nodes
    CoverCounts mCounts;               ///< of the living nodes' regions
    BallGrid mMerged;                  ///< living nodes that are no leaves
};

} // namespace tight
} // namespace openvdb_spheretree
