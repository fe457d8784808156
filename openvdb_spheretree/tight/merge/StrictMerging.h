// SPDX-License-Identifier: Apache-2.0
/// @file StrictMerging.h
/// @brief Plain merging: a ball holds everything that is held below it, and costs the outside voxels
/// in it, whoever else has them.
///
/// What is held are the voxels of the leaves' cells (PowerCells.h): every voxel stays with the leaf
/// that covers it best, so the balls above that leaf are its chain. That is quality=fast. Or it is
/// the leaf balls themselves, for cover=balls.
///
/// What a merge costs depends on its two nodes alone and is never looked at twice.

#pragma once

#include "MergeForest.h"
#include <openvdb_spheretree/tight/fit/BallFit.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <openvdb/Types.h>

#include <vector>

namespace openvdb_spheretree {
namespace tight {

/// What a node holds: balls; a voxel is one of radius 0.
using Held = std::vector<FineBall>;

/// What the leaves of a merging hold.
struct HeldByLeaves {
    std::vector<Held> held;
    bool areVoxels;        ///< of which only the corners of their hull count
    bool areInside = true; ///< the leaves have no voxel outside the object
};

class StrictMerging : public MergeModel {
public:
    /// @param leaves  whose union is the object
    /// @param flat    centres keep their z
    StrictMerging(const SampledObject& object, std::vector<FineBall> leaves, HeldByLeaves held,
        const FitEffort& effort, bool flat, openvdb::util::NullInterrupter* interrupter);

    std::vector<FineBall> leaves() const override { return mBalls; }
    MergeCandidate evaluate(int32_t a, int32_t b) const override;
    void complete(MergeCandidate& merge) const override;
    void merge(const std::vector<MergeCandidate>& merges, int32_t node) override;
    bool dependsOnOthers() const override { return false; }

private:
    const SampledObject& mObject;
    FitEffort mEffort;
    bool mFlat, mVoxels;
    openvdb::util::NullInterrupter* mInterrupter;
    std::vector<FineBall> mBalls;
    std::vector<Held> mHeld;    ///< of living nodes: all there is, or all of its extreme voxels
    std::vector<Held> mExtreme; ///< the part that is asked while a ball is sought; of living nodes
    std::vector<double> mCost;  ///< outside voxels in a node's ball
};

/// @return the extreme points of cells as what leaves hold.
HeldByLeaves heldVoxels(const std::vector<std::vector<openvdb::Coord>>& cellPoints);
/// @return each leaf's own ball.
HeldByLeaves heldBalls(const std::vector<FineBall>& leaves);

} // namespace tight
} // namespace openvdb_spheretree
