// SPDX-License-Identifier: Apache-2.0
#include "MedialCover.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/tree/LevelFrame.h>

#include <openvdb/math/Math.h>

#include <atomic>

namespace openvdb_spheretree::detail {

bool areMedialBalls(const SphereTree& tree, const SphereTreeLevel& level,
    const openvdb::MaskTree& object, int64_t voxels, openvdb::util::NullInterrupter* interrupter)
{
    const SphereTreeSettings& settings = tree.settings;
    const Spheres& spheres = tree.spheres;
    // Whether the level can have medial balls for spheres. In two dimensions drawing is fast.
    if (level.level != 0 || settings.dim != 3 || !settings.dist().isEuclidean()
        || settings.type() == TreeType::Tight || settings.isInner() || tree.subdivision != 2) {
        return false;
    }
    double rows = 0; // of voxels that would be drawn, each ball by itself
    for (int32_t id = level.begin; id < level.end; ++id) {
        rows += 1 + openvdb::math::pi<double>() / 4 * double(spheres.coverRadiusSq[id]);
    }
    constexpr double kRowVoxels = 4; // a row takes as long as so many voxels of the transforms
    if (kRowVoxels * rows < double(voxels)) return false;
    LevelQueries queries;
    queries.memory = settings.memory;
    const MedialLevel medial(object, 3, settings.dist(), interrupter, nullptr, queries);
    if (medial.balls.size() != std::size_t(level.size())) return false;
    const LevelFrame frame(0, tree.origin, settings);
    std::atomic<bool> same{true};
    parallelFor(medial.balls.size(), interrupter, [&](std::size_t i) {
        const std::size_t id = std::size_t(level.begin) + i;
        const MedialBall& ball = medial.balls[i];
        const bool isBall = spheres.center[id] == frame.center(ball.center).halved()
            && spheres.coverRadiusSq[id] == frame.radius(ball.radiusSq).coverSq();
        if (!isBall) same.store(false, std::memory_order_relaxed);
    });
    return same;
}

} // namespace openvdb_spheretree::detail
