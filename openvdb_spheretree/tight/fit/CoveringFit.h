// SPDX-License-Identifier: Apache-2.0
/// @file CoveringFit.h
/// @brief Finds a ball that holds given targets, voxels or balls, and costs as little as possible.

#pragma once

#include "BallFit.h"
#include "CostRuns.h"
#include "CostWindow.h"
#include "PointCloud.h"

#include <openvdb/Types.h>

#include <vector>

namespace openvdb_spheretree::tight {

struct FittedBall {
    ExactSphere ball;
    double cost = 0; ///< voxels, counted on samples
};

/// @return the smallest squared radius around the center of @a ball that holds @a held, a ball.
int64_t radiusSqToHold(const ExactSphere& ball, const ExactSphere& held);
/// @return the same for all these voxels.
int64_t radiusSqToHold(const ExactSphere& ball, const std::vector<openvdb::Coord>& voxels);

/// Owns the window of what costs, and all lists: reused for many fits, it allocates once.
class CoveringFit {
public:
    /// Opens the window around @a targets and @a replaced. All that is outside the object costs
    /// there.
    /// @param targets   voxels or balls that the new ball must hold; not empty
    /// @param replaced  balls whose place it takes
    /// @param samples   of a radius, at most: FitEffort
    void open(const SampledObject& object, const std::vector<openvdb::Coord>& targets,
        const std::vector<ExactSphere>& replaced, int samples);
    void open(const SampledObject& object, const std::vector<ExactSphere>& targets,
        const std::vector<ExactSphere>& replaced, int samples);
    /// Opens the window around @a ball alone, to find its cost.
    void open(const SampledObject& object, const ExactSphere& ball, int samples)
    {
        open(object, std::vector<ExactSphere>{ball}, {}, samples);
    }

    /// @return what the window covers.
    const FineBox& box() const { return mBox; }
    /// Voxels in @a ball, another one of the cover, cost nothing.
    void cover(const ExactSphere& ball) { mWindow.cover(ball); }

    /// @return what the balls cost together, voxels.
    double costOf(const std::vector<ExactSphere>& balls);
    /// @return the best ball found. It holds all targets, exactly. The centers of the replaced
    /// balls are tried, too.
    FittedBall best(const FitEffort& effort, bool flat);

private:
    void openWindow(const SampledObject& object, int samples);

    std::vector<ExactSphere> mTargets, mReplaced; ///< a voxel is a ball of radius 0
    FineBox mBox;
    CostWindow mWindow, mLeft;
    PointCloud mPoints;
    CostRuns mCosts;
    std::vector<LocalBall> mStarts;
};

} // namespace openvdb_spheretree::tight
