// SPDX-License-Identifier: Apache-2.0
/// @file BallFit.h
/// @brief The ball of least cost that holds given points: a descent over its centre.
///
/// A centre decides the radius, so there are three unknowns. From the smallest enclosing ball and
/// from the centres that were there before, steps along the axes (and diagonals), of a quarter of
/// the radius down to 1/16 of a sample, as long as the cost falls. A candidate that contains the
/// best ball so far cannot cost less, and is not counted. Nothing is random.

#pragma once

#include "CostRuns.h"
#include "PointCloud.h"

#include <vector>

namespace openvdb_spheretree {
namespace tight {

struct BallFit {
    LocalBall ball;
    int64_t cost = INT64_MAX; ///< samples
};

/// How hard to look.
struct FitEffort {
    bool diagonals = false; ///< also the 20 directions that are no axes
    int stepsPerSize = 12;  ///< rounds of steps of one size
    int smallest = 1;       ///< the last size of steps, 1/16 sample
    bool restarts = false;  ///< descend from each start, not only from the best of them
    int samples = 16;       ///< costs are counted with up to so many in a radius
};

/// @param points    not empty; in the window's coordinates
/// @param smallest  the smallest ball around the points
/// @param costs     around its centre; balls that reach further are not tried
/// @param starts    centres to try, their radii are not looked at
/// @param flat      leave z alone
BallFit fitBall(const PointCloud& points, const LocalBall& smallest, const CostRuns& costs,
    const std::vector<LocalBall>& starts, const FitEffort& effort, bool flat = false);

/// @return the smallest ball around the points, never too small; its centre is among integers, and
/// its radius to about one more, or a percent, the smallest.
LocalBall smallestBall(const PointCloud& points, bool flat = false);

} // namespace tight
} // namespace openvdb_spheretree
