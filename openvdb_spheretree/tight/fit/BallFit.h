// SPDX-License-Identifier: Apache-2.0
/// @file BallFit.h
/// @brief A cheap ball that holds given points: a descent over its center.
///
/// The center decides the radius, so there are three unknowns. The descent starts at the smallest
/// enclosing ball and at given centers. It moves the center along the axes (and diagonals) as long
/// as the cost falls, at first by a quarter of the radius, in the end by 1/16 of a sample. A
/// candidate that contains the best ball so far cannot cost less, and is not counted. Nothing is
/// random.

#pragma once

#include "CostRuns.h"
#include "PointCloud.h"

#include <vector>

namespace openvdb_spheretree::tight {

struct BallFit {
    LocalBall ball;
    int64_t cost = INT64_MAX; ///< samples

    /// @return whether it costs less, or the same with a smaller ball.
    bool isBetterThan(const BallFit& o) const
    {
        return cost < o.cost || (cost == o.cost && ball.radiusSq < o.ball.radiusSq);
    }
};

/// How long to search.
struct FitEffort {
    bool diagonals = false; ///< also steps in the 20 diagonal directions
    int stepsPerSize = 12;  ///< rounds of steps of one size, at most
    int smallest = 1;       ///< the last size of steps, 1/16 sample
    bool restarts = false;  ///< descend from each start, not only from the best of them
    int samples = 16;       ///< costs are counted with at most so many in a radius
};

/// @param points    not empty; in the window's coordinates
/// @param smallest  the smallest ball around the points
/// @param costs     collected around its center; balls that reach out of them are not tried
/// @param starts    centers to try; their radii do not matter
/// @param flat      the center keeps its z
BallFit fitBall(const PointCloud& points, const LocalBall& smallest, const CostRuns& costs,
    const std::vector<LocalBall>& starts, const FitEffort& effort, bool flat = false);

/// @return a ball around all points with a center of integers. Its radius is that of the smallest
/// one, up to about one unit or one percent.
LocalBall smallestBall(const PointCloud& points, bool flat = false);

} // namespace openvdb_spheretree::tight
