// SPDX-License-Identifier: Apache-2.0
/// @file StrictMerging.h
/// @brief Plain merging. A ball holds all that the nodes below it hold. It costs the outside voxels
/// in it, also those that are in other balls.
///
/// A leaf ball holds the voxels of its power cell (PowerCells.h), or of a part of it. The chain of
/// a voxel is the leaf ball whose cell it is in, and the balls above that. With cover=balls, a leaf
/// ball holds itself.
///
/// What a merge costs depends on its two nodes alone, and is evaluated once.

#pragma once

#include "CoverBall.h"
#include "MergeForest.h"
#include <openvdb_spheretree/tight/fit/BallFit.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <openvdb/Types.h>

#include <vector>

namespace openvdb_spheretree::tight {

/// What a node holds: balls; a voxel is a ball of radius 0.
using Held = std::vector<ExactSphere>;

/// What each leaf ball holds.
struct HeldByLeafBalls {
    std::vector<Held> held;
    bool areVoxels; ///< then only the corners of their hull matter
    bool areInside; ///< the leaf balls have no voxel outside the object
};

class StrictMerging : public MergeModel {
public:
    /// @param leafBalls  that are merged
    /// @param flat       centers keep their z
    StrictMerging(const SampledObject& object, const std::vector<CoverBall>& leafBalls,
        HeldByLeafBalls held, const FitEffort& effort, bool flat,
        openvdb::util::NullInterrupter* interrupter);

    std::vector<ExactSphere> leafBalls() const override { return mBalls; }
    int32_t groupOf(int32_t leafBall) const override { return mGroups[leafBall]; }
    MergeCandidate evaluate(int32_t a, int32_t b) const override;
    void complete(MergeCandidate& merge) const override;
    void merge(const std::vector<MergeCandidate>& merges, int32_t node) override;
    bool dependsOnOthers() const override { return false; }

private:
    const SampledObject& mObject;
    FitEffort mEffort;
    bool mFlat, mVoxels;
    openvdb::util::NullInterrupter* mInterrupter;
    std::vector<ExactSphere> mBalls;
    std::vector<int32_t> mGroups; ///< of leaf balls
    std::vector<Held>
        mHeld; ///< of living nodes: all balls; of voxels, mExtreme has all that matter
    std::vector<Held> mExtreme; ///< of living nodes: the part that a new ball is fitted to
    std::vector<double> mCost;  ///< outside voxels in a node's ball
};

/// @param points     extreme points of each leaf ball's power cell
/// @param areInside  as of HeldByLeafBalls
HeldByLeafBalls heldVoxels(const std::vector<std::vector<openvdb::Coord>>& points, bool areInside);
/// @return each leaf ball itself.
HeldByLeafBalls heldBalls(const std::vector<ExactSphere>& leafBalls, bool areInside);

} // namespace openvdb_spheretree::tight
