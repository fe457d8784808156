// SPDX-License-Identifier: Apache-2.0
/// @file SlackMerging.h
/// @brief Merging with slack (cuts of quality=normal, and few balls below another level). A ball
/// must hold only what no other ball of the cover holds. It costs the outside voxels in it that are
/// in no other ball.
///
/// Each node has a region of object voxels. The region of a leaf ball are the voxels in it. The
/// region of a merged node are those voxels of its children's regions that its own ball holds. A
/// new node must hold the voxels that are in its children's regions alone. These are often few:
/// where balls overlap, voxels are in other regions, too.
///
/// Every cut is valid: the regions of its nodes cover the object, since a merge leaves no voxel
/// without a region, and a node never changes later. Each voxel of a node's region is in the region
/// of one of its children. So a chain of balls that hold it leads down to a leaf ball.

#pragma once

#include "CoverBall.h"
#include "MergeForest.h"
#include <openvdb_spheretree/tight/fit/BallFit.h>
#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/tight/region/CoverCounts.h>
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include <vector>

namespace openvdb_spheretree::tight {

class SlackMerging : public MergeModel {
public:
    /// @param leafBalls  that are merged
    /// @param regions    voxels of each leaf ball; together the object
    /// @param flat       centers keep their z
    /// @param areInside  the leaf balls have no voxel outside the object
    SlackMerging(const SampledObject& object, const std::vector<CoverBall>& leafBalls,
        std::vector<VoxelRegion> regions, const FitEffort& effort, bool flat,
        openvdb::util::NullInterrupter* interrupter, bool areInside);

    std::vector<ExactSphere> leafBalls() const override
    {
        return {mBalls.begin(), mBalls.begin() + mLeafBalls};
    }
    int32_t groupOf(int32_t leafBall) const override { return mGroups[leafBall]; }
    MergeCandidate evaluate(int32_t a, int32_t b) const override;
    void merge(const std::vector<MergeCandidate>& merges, int32_t node) override;
    bool dependsOnOthers() const override { return true; }

private:
    bool isInside(int32_t node) const { return mAreInside && node < mLeafBalls; }

    const SampledObject& mObject;
    const SampleLevel& mVoxels;
    FitEffort mEffort;
    bool mFlat;
    openvdb::util::NullInterrupter* mInterrupter;
    int32_t mLeafBalls;
    bool mAreInside; ///< the leaf balls: they cost nothing
    std::vector<ExactSphere> mBalls;
    std::vector<int32_t> mGroups;      ///< of leaf balls
    std::vector<VoxelRegion> mRegions; ///< of living nodes
    CoverCounts mCounts;               ///< of the living nodes' regions
    BallGrid mMerged;                  ///< living nodes that may cost something
};

} // namespace openvdb_spheretree::tight
