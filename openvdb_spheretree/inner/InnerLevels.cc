// SPDX-License-Identifier: Apache-2.0
#include "InnerLevels.h"

#include "InnerOrder.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Rounding.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/index/PowerTree.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {
namespace detail {

namespace {

/// A level's balls by their places in the order, themselves ordered by center.
std::vector<int32_t> byCenter(const std::vector<MedialBall>& balls, int64_t count)
{
    std::vector<int32_t> places(count);
    for (int64_t i = 0; i < count; ++i) places[i] = int32_t(i);
    std::sort(places.begin(), places.end(),
        [&](int32_t a, int32_t b) { return balls[a].center < balls[b].center; });
    return places;
}

/// The closed sphere of a ball's voxels.
struct Sphere {
    double radius;
    int64_t coverSq;
    float radiusWorld;
};

Sphere sphereOf(const MedialBall& ball, const SphereTree& tree)
{
    const int64_t closedSq = int64_t(ball.radiusSq) - 1;
    const double radius = sqrtDown(double(closedSq));
    const float world = toFloatDown(multiplyDown(radius, smallestStretch(*tree.transform)));
    if (!std::isfinite(world)) {
        OPENVDB_THROW(openvdb::ValueError,
            "a radius of " << radius << " voxels of " << tree.voxelSize()
                           << " does not fit a float: use another unit of length");
    }
    return {radius, closedSq * tree.subdivision * tree.subdivision, world};
}

void appendNode(SphereTree& tree, const MedialBall& ball, int32_t parent)
{
    const Sphere sphere = sphereOf(ball, tree);
    tree.spheres.center.push_back(ball.center.asVec3d());
    tree.spheres.radius.push_back(sphere.radius);
    tree.spheres.coverRadiusSq.push_back(sphere.coverSq);
    tree.spheres.radiusWorld.push_back(sphere.radiusWorld);
    tree.spheres.parent.push_back(parent);
    tree.ijk.push_back(ball.center);
    tree.radiusSq.push_back(ball.radiusSq);
}

/// The nodes of one level, below those of the level that was appended last.
class LevelAppender {
public:
    LevelAppender(SphereTree& tree, const std::vector<MedialBall>& balls,
        openvdb::util::NullInterrupter* interrupter)
        : mTree(tree), mBalls(balls), mInterrupter(interrupter)
    {}

    void append(SphereTreeLevel& level, int64_t count)
    {
        const std::vector<int32_t> places = byCenter(mBalls, count);
        const std::vector<int32_t> parents = parentsOf(places);
        level.begin = mTree.size();
        mIdAt.resize(count);
        for (std::size_t i = 0; i < places.size(); ++i) {
            mIdAt[places[i]] = mTree.size();
            appendNode(mTree, mBalls[places[i]], parents[i]);
        }
        level.end = mTree.size();
        mAbove = places;
    }

private:
    /// The ids of the parents, given where the level's balls are in the order.
    std::vector<int32_t> parentsOf(const std::vector<int32_t>& places) const
    {
        std::vector<int32_t> parents(places.size(), -1);
        if (mAbove.empty()) return parents;
        std::vector<MedialBall> above;
        for (const int32_t place : mAbove) above.push_back(mBalls[place]);
        const PowerSearch search(std::move(above));
        parallelFor(places.size(), mInterrupter, [&](std::size_t i) {
            const bool isAbove = places[i] < int32_t(mAbove.size());
            const int32_t place =
                isAbove ? places[i] : mAbove[search.nearest(mBalls[places[i]].center)];
            parents[i] = mIdAt[place];
        });
        return parents;
    }

    SphereTree& mTree;
    const std::vector<MedialBall>& mBalls;
    openvdb::util::NullInterrupter* mInterrupter;
    std::vector<int32_t> mAbove; ///< of the level above: places, by center
    std::vector<int32_t> mIdAt;  ///< of the same: id by place
};

void appendCuts(SphereTree& tree, const std::vector<MedialBall>& balls)
{
    const int32_t total = int32_t(balls.size());
    for (int32_t i = 0; i < total; ++i) {
        const Sphere sphere = sphereOf(balls[i], tree);
        tree.cuts.spheres.center.push_back(balls[i].center.asVec3d());
        tree.cuts.spheres.radius.push_back(sphere.radius);
        tree.cuts.spheres.coverRadiusSq.push_back(sphere.coverSq);
        tree.cuts.spheres.radiusWorld.push_back(sphere.radiusWorld);
        tree.cuts.spheres.parent.push_back(-1);
        tree.cuts.first.push_back(i + 1);
        tree.cuts.last.push_back(total);
    }
}

/// The largest number of balls that anybody asks for.
int64_t mostWanted(const BudgetOptions& options)
{
    const std::vector<int64_t>& spheres = options.budget.spheres;
    if (options.cuts || spheres.empty()) return INT64_MAX;
    return *std::max_element(spheres.begin(), spheres.end());
}

} // namespace

void appendInnerTree(SphereTree& tree, const openvdb::MaskTree& voxels, StageSeconds& seconds,
    openvdb::util::NullInterrupter* interrupter)
{
    const BudgetOptions& options = tree.settings.budgeted();
    LevelQueries queries;
    queries.memory = tree.settings.memory;
    const MedialLevel medial(
        voxels, tree.settings.dim, tree.settings.dist(), interrupter, &seconds, queries);
    const InnerOrder order = timed("inner balls", interrupter, &seconds.tree, [&] {
        return innerOrder(
            medial.layout, medial.balls, tree.settings.dim, mostWanted(options), interrupter);
    });
    const std::vector<MedialBall> balls =
        ballsInOrder(medial.balls, order, FlatAxis(tree.flatAxis));
    const std::vector<int64_t> counts = options.budget.counts(int64_t(balls.size()));
    tree.levels.resize(counts.size());
    timed("inner levels", interrupter, &seconds.tree, [&] {
        LevelAppender levels(tree, balls, interrupter);
        for (int k = int(counts.size()) - 1; k >= 0; --k) {
            tree.levels[k].level = k;
            tree.levels[k].pyramidVoxels = order.covered[counts[k] - 1];
            levels.append(tree.levels[k], counts[k]);
        }
    });
    if (order.covered[counts[0] - 1] == medial.layout.voxelCount() && tree.settings.topology) {
        tree.levels[0].topology = timed("topology", interrupter, &seconds.topology,
            [&] { return levelTopology(medial.layout, interrupter); });
    }
    if (options.cuts) appendCuts(tree, balls);
}

} // namespace detail
} // namespace openvdb_spheretree
