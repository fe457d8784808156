// SPDX-License-Identifier: Apache-2.0
#include "ClusterCover.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>

#include <algorithm>

namespace openvdb_spheretree::tight {

namespace {

/// @return balls of one size around the centers, each of which holds all of the object: their power
/// cells are the voxels nearest to each center.
std::vector<ExactSphere> equalBalls(
    const std::vector<FineCenter>& centers, const SampleLevel& object)
{
    FineBox box;
    for (std::size_t leaf = 0; leaf < object.leafCount(); ++leaf) {
        const openvdb::Coord& origin = object.origin(leaf);
        box.expand(voxelBall(origin));
        box.expand(voxelBall(origin.offsetBy(kLeafDim - 1)));
    }
    for (const FineCenter& center : centers) box.expand({{center[0], center[1], center[2]}, 0});
    int64_t reachSq = 0;
    for (int a = 0; a < 3; ++a) reachSq += (box.hi[a] - box.lo[a]) * (box.hi[a] - box.lo[a]);
    std::vector<ExactSphere> balls;
    for (const FineCenter& center : centers) {
        balls.push_back({{center[0], center[1], center[2]}, reachSq});
    }
    return balls;
}

} // namespace

std::vector<ExactSphere> clusterCover(const std::vector<FineCenter>& centers,
    const SampledObject& object, const FitEffort& effort, bool flat,
    openvdb::util::NullInterrupter* interrupter)
{
    const SampleLevel& voxels = object.level(0);
    const auto points = powerCellPoints(equalBalls(centers, voxels), voxels, interrupter);
    std::vector<ExactSphere> balls(centers.size());
    detail::parallelFor(balls.size(), interrupter, [&](std::size_t i) {
        if (points[i].empty()) return;
        thread_local CoveringFit fit;
        fit.open(object, points[i], {}, effort.samples);
        balls[i] = fit.best(effort, flat).ball;
    });
    balls.erase(std::remove_if(balls.begin(), balls.end(),
                    [](const ExactSphere& ball) { return ball.empty(); }),
        balls.end());
    return balls;
}

} // namespace openvdb_spheretree::tight
