// SPDX-License-Identifier: Apache-2.0
#include "InnerLevels.h"

#include "CubeDistance.h"
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
#include <numeric>
#include <utility>

namespace openvdb_spheretree::detail {

namespace {

/// Appends the closed sphere of a ball's voxels to the spheres of @a tree, or of its cuts.
void appendSphere(Spheres& spheres, const MedialBall& ball, int32_t parent, const SphereTree& tree)
{
    const int64_t closedSq = int64_t(ball.radiusSq) - 1;
    const double radius = sqrtDown(double(closedSq));
    const float world = toFloatDown(multiplyDown(radius, smallestStretch(*tree.transform)));
    if (!std::isfinite(world)) {
        OPENVDB_THROW(openvdb::ValueError,
            "a radius of " << radius << " voxels of " << tree.voxelSize()
                           << " does not fit a float: use another unit of length");
    }
    spheres.center.push_back(ball.center.asVec3d());
    spheres.radius.push_back(radius);
    spheres.coverRadiusSq.push_back(closedSq * tree.subdivision * tree.subdivision);
    spheres.radiusWorld.push_back(world);
    spheres.parent.push_back(parent);
}

/// Appends levels, the coarsest first. Balls go by their places in the greedy order.
class LevelAppender {
public:
    LevelAppender(SphereTree& tree, const std::vector<MedialBall>& balls,
        openvdb::util::NullInterrupter* interrupter)
        : mTree(tree), mBalls(balls), mInterrupter(interrupter)
    {}

    /// The level of the first @a count balls.
    void append(SphereTreeLevel& level, int64_t count)
    {
        std::vector<int32_t> places(count);
        std::iota(places.begin(), places.end(), 0);
        std::sort(places.begin(), places.end(),
            [&](int32_t a, int32_t b) { return mBalls[a].center < mBalls[b].center; });
        const std::vector<int32_t> parents = parentsOf(places);
        level.begin = mTree.size();
        mIdAt.resize(count);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const MedialBall& ball = mBalls[places[i]];
            mIdAt[places[i]] = mTree.size();
            appendSphere(mTree.spheres, ball, parents[i], mTree);
            mTree.ijk.push_back(ball.center);
            mTree.radiusSq.push_back(ball.radiusSq);
        }
        level.end = mTree.size();
        mAbove = std::move(places);
    }

private:
    /// @return the ids of the parents of the balls at these places.
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

/// The balls that spheres may be: with strict=1 made smaller, so that they stay within cubes.
std::vector<MedialBall> candidatesOf(const MedialLevel& medial, const openvdb::MaskTree& voxels,
    const SphereTreeSettings& settings, openvdb::util::NullInterrupter* interrupter)
{
    if (!settings.find<InnerOptions>()->strict) return medial.balls;
    const int flatAxis = settings.dim == 2 ? 2 : -1;
    return withinCubes(medial.balls, CubeDistance(voxels, flatAxis, interrupter), interrupter);
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
    const std::vector<int64_t>& spheres = options.budget.spheres;
    const int64_t most = options.cuts || spheres.empty()
        ? INT64_MAX
        : *std::max_element(spheres.begin(), spheres.end());
    std::vector<MedialBall> candidates;
    const InnerOrder order = timed("inner balls", interrupter, &seconds.tree, [&] {
        candidates = candidatesOf(medial, voxels, tree.settings, interrupter);
        return innerOrder(medial.layout, candidates, tree.settings.dim, most, interrupter);
    });
    const std::vector<MedialBall> balls = ballsInOrder(candidates, order, FlatAxis(tree.flatAxis));
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
    if (!options.cuts) return;
    for (int32_t i = 0; i < int32_t(balls.size()); ++i) {
        appendSphere(tree.cuts.spheres, balls[i], -1, tree);
        tree.cuts.first.push_back(i + 1);
        tree.cuts.last.push_back(int32_t(balls.size()));
    }
}

} // namespace openvdb_spheretree::detail
