// SPDX-License-Identifier: Apache-2.0
#include "MedialCover.h"

#include "../LevelFrame.h"
#include "../MedialLevel.h"

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {
namespace detail {
namespace {

/// Whether the level can have medial balls for spheres. In two dimensions drawing is fast.
bool mayBeMedial(const SphereTree& tree, const SphereTreeLevel& level)
{
    const SphereTreeSettings& settings = tree.settings;
    return level.level == 0 && settings.dim == 3 && settings.dist.isEuclidean()
        && settings.tree != TreeType::Tight && settings.side == Side::Outer;
}

/// @return the rows of voxels that are drawn, each ball by itself.
double drawnRows(const std::vector<ExactSphere>& spheres, const SphereMetric& metric)
{
    const double unitSq = double(metric.subdivision) * metric.subdivision;
    double rows = 0;
    for (const ExactSphere& sphere : spheres) rows += 1 + M_PI / unitSq * double(sphere.coverSq);
    return rows;
}

bool isBall(const ExactSphere& sphere, const MedialBall& ball, const LevelFrame& frame)
{
    const Doubled center = frame.center(ball.center);
    return sphere.center[0] == center.x && sphere.center[1] == center.y
        && sphere.center[2] == center.z && sphere.coverSq == frame.radius(ball.radiusSq).coverSq();
}

} // namespace

bool areMedialBalls(const std::vector<ExactSphere>& spheres, const SphereTree& tree,
    const SphereTreeLevel& level, const openvdb::MaskTree& object, int64_t voxels,
    openvdb::util::NullInterrupter* interrupter)
{
    const SphereMetric metric = metricOf(tree);
    if (!mayBeMedial(tree, level) || metric.subdivision != 2) return false;
    constexpr double kRowVoxels = 4; // a row takes as long as so many voxels of the transforms
    if (kRowVoxels * drawnRows(spheres, metric) < double(voxels)) return false;
    LevelWants wants;
    wants.memory = tree.settings.memory;
    const MedialLevel medial(object, 3, tree.settings.dist, interrupter, nullptr, wants);
    const LevelFrame frame(0, tree.origin, tree.settings);
    return std::equal(spheres.begin(), spheres.end(), medial.balls.begin(), medial.balls.end(),
        [&](const ExactSphere& sphere, const MedialBall& ball) {
            return isBall(sphere, ball, frame);
        });
}

} // namespace detail
} // namespace openvdb_spheretree
