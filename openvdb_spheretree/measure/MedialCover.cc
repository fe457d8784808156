// SPDX-License-Identifier: Apache-2.0
#include "MedialCover.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/tree/LevelFrame.h>

#include <openvdb/math/Math.h>

#include <atomic>
#include <cmath>

namespace openvdb_spheretree {
namespace detail {
namespace {

/// Whether the level can have medial balls for spheres. In two dimensions drawing is fast.
bool mayBeMedial(const SphereTree& tree, const SphereTreeLevel& level)
{
    const SphereTreeSettings& settings = tree.settings;
    return level.level == 0 && settings.dim == 3 && settings.dist().isEuclidean()
        && settings.type() != TreeType::Tight && !settings.isInner() && tree.subdivision == 2;
}

/// @return the rows of voxels that are drawn, each ball by itself.
double drawnRows(const SphereTree& tree, const SphereTreeLevel& level)
{
    double rows = 0;
    for (int32_t id = level.begin; id < level.end; ++id) {
        rows += 1 + openvdb::math::pi<double>() / 4 * double(tree.spheres.coverRadiusSq[id]);
    }
    return rows;
}

bool isBall(const SphereTree& tree, int32_t id, const MedialBall& ball, const LevelFrame& frame)
{
    return tree.spheres.center[id] == frame.center(ball.center).halved()
        && tree.spheres.coverRadiusSq[id] == frame.radius(ball.radiusSq).coverSq();
}

} // namespace

bool areMedialBalls(const SphereTree& tree, const SphereTreeLevel& level,
    const openvdb::MaskTree& object, int64_t voxels, openvdb::util::NullInterrupter* interrupter)
{
    constexpr double kRowVoxels = 4; // a row takes as long as so many voxels of the transforms
    if (!mayBeMedial(tree, level)) return false;
    if (kRowVoxels * drawnRows(tree, level) < double(voxels)) return false;
    LevelQueries queries;
    queries.memory = tree.settings.memory;
    const MedialLevel medial(object, 3, tree.settings.dist(), interrupter, nullptr, queries);
    if (medial.balls.size() != std::size_t(level.size())) return false;
    const LevelFrame frame(0, tree.origin, tree.settings);
    std::atomic<bool> same{true};
    parallelFor(medial.balls.size(), interrupter, [&](std::size_t i) {
        if (isBall(tree, level.begin + int32_t(i), medial.balls[i], frame)) return;
        same.store(false, std::memory_order_relaxed);
    });
    return same;
}

} // namespace detail
} // namespace openvdb_spheretree
