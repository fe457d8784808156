// SPDX-License-Identifier: Apache-2.0
/// @file DebtFit.h
/// @brief Finds the ball that pays a debt: holds given voxels, or balls, and as little as possible
/// that costs.

#pragma once

#include "BallFit.h"
#include "CostRuns.h"
#include "CostWindow.h"
#include "PointCloud.h"

#include <openvdb/Types.h>

#include <vector>

namespace openvdb_spheretree {
namespace tight {

struct PaidDebt {
    FineBall ball;
    double cost = 0; ///< voxels, counted on samples
};

/// @return the smallest squared radius around the centre of @a ball that holds @a held, a ball.
int64_t radiusSqToHold(const FineBall& ball, const FineBall& held);

/// Memory of one thread, and the window of what costs.
class DebtFit {
public:
    /// The window around @a debt and the balls @a olds: everything outside the object costs in there.
    /// @param debt     voxels, or balls, to be held; not empty
    /// @param samples  of a radius, at most: FitEffort
    void open(const SampledObject& object, const std::vector<openvdb::Coord>& debt,
        const std::vector<FineBall>& olds, int samples);
    void open(const SampledObject& object, const std::vector<FineBall>& debt,
        const std::vector<FineBall>& olds, int samples);
    /// What the window reaches over; balls that meet it may want to cover() their part.
    const FineBox& box() const { return mBox; }
    void cover(const FineBall& ball) { mWindow.cover(ball); }

    /// @return what the balls cost together, voxels.
    double costOf(const std::vector<FineBall>& balls);
    /// @return the best ball found; the centres of `olds` are tried, too. Holds all of the debt,
    /// exactly.
    PaidDebt pay(const FitEffort& effort, bool flat);

private:
    void openWindow(const SampledObject& object, int samples);

    std::vector<FineBall> mDebt, mOlds; ///< a voxel is a ball of radius 0
    FineBox mBox;
    CostWindow mWindow, mLeft;
    PointCloud mPoints;
    CostRuns mCosts;
    std::vector<LocalBall> mStarts;
};

} // namespace tight
} // namespace openvdb_spheretree
