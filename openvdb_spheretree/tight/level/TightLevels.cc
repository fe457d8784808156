// SPDX-License-Identifier: Apache-2.0
#include "TightLevels.h"

#include <openvdb_spheretree/base/Rounding.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

using openvdb::Coord;
using openvdb::Vec3d;

bool isIn(const ForestNode& node, int64_t count)
{
    return node.first <= count && count <= node.last;
}

Vec3d centerOf(const ExactSphere& ball)
{
    const double unit = 1.0 / double(kFine);
    return unit * Vec3d(double(ball.center[0]), double(ball.center[1]), double(ball.center[2]));
}

/// Appends a ball to spheres, without its stored radius.
void append(Spheres& spheres, const ExactSphere& ball, const Vec3d& center, int32_t parent)
{
    spheres.center.push_back(center);
    // In voxels, rounded up; division by 16 is exact.
    spheres.radius.push_back(detail::sqrtUp(detail::toDoubleUp(ball.radiusSq)) / double(kFine));
    spheres.coverRadiusSq.push_back(ball.radiusSq);
    spheres.parent.push_back(parent);
}

/// @return the parents of the nodes of a cut in a coarser one.
std::vector<int32_t> parentsIn(const std::vector<ForestNode>& forest,
    const std::vector<int32_t>& nodes, int64_t coarser,
    const std::vector<ExactSphere>& coarserBalls)
{
    const std::vector<int32_t> cut = cutOf(forest, coarser);
    const BallGrid grid(coarserBalls);
    std::vector<int32_t> parents;
    for (const int32_t node : nodes) {
        int32_t ancestor = node;
        while (ancestor >= 0 && !isIn(forest[ancestor], coarser))
            ancestor = forest[ancestor].parent;
        parents.push_back(ancestor < 0
                ? leastProtruding(forest[node].ball, coarserBalls, grid)
                : int32_t(std::lower_bound(cut.begin(), cut.end(), ancestor) - cut.begin()));
    }
    return parents;
}

/// Appends one level. Its balls get their ids by voxel, x first.
/// @return the id of each ball.
std::vector<int32_t> appendLevel(
    const TightLevel& from, int level, const std::vector<int32_t>& idsAbove, SphereTree& tree)
{
    const FlatAxis flat(tree.flatAxis);
    std::vector<Coord> ijk;
    std::vector<Vec3d> centers;
    for (std::size_t i = 0; i < from.balls.size(); ++i) {
        centers.push_back(flat.fromZ(centerOf(from.balls[i])));
        Coord& voxel = ijk.emplace_back(); // the nearest one
        for (int a = 0; a < 3; ++a) voxel[a] = int32_t(std::floor(centers.back()[a] + 0.5));
    }
    std::vector<int32_t> order(ijk.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(
        order.begin(), order.end(), [&](int32_t a, int32_t b) { return ijk[a] < ijk[b]; });
    SphereTreeLevel& range = tree.levels[level];
    range.level = level;
    range.begin = tree.size();
    range.pyramidVoxels = from.digital.empty() ? 0 : tree.object.voxels;
    std::vector<int32_t> ids(from.balls.size());
    for (const int32_t i : order) {
        ids[i] = tree.size();
        append(tree.spheres, from.balls[i], centers[i],
            from.parent.empty() ? -1 : idsAbove[from.parent[i]]);
        tree.ijk.push_back(ijk[i]);
        tree.radiusSq.push_back(from.digital.empty() ? -1 : from.digital[i].radiusSq);
    }
    range.end = tree.size();
    return ids;
}

/// @return the same as leastProtruding() among those of @a level that are named; 0 if none is.
int32_t leastAmong(
    const std::vector<int32_t>& ids, const ExactSphere& ball, const std::vector<ExactSphere>& level)
{
    std::vector<ExactSphere> balls;
    for (const int32_t i : ids) balls.push_back(level[std::size_t(i)]);
    return ids.empty() ? 0 : ids[std::size_t(leastProtruding(ball, balls))];
}

} // namespace

std::vector<ExactSphere> allBalls(const std::vector<TightLevel>& levels)
{
    std::vector<ExactSphere> all;
    for (const TightLevel& level : levels) {
        all.insert(all.end(), level.balls.begin(), level.balls.end());
    }
    return all;
}

std::vector<int32_t> cutOf(const std::vector<ForestNode>& forest, int64_t count)
{
    std::vector<int32_t> nodes;
    for (std::size_t i = 0; i < forest.size(); ++i) {
        if (isIn(forest[i], count)) nodes.push_back(int32_t(i));
    }
    return nodes;
}

std::vector<ExactSphere> ballsOfCut(const std::vector<ForestNode>& forest, int64_t count)
{
    std::vector<ExactSphere> balls;
    for (const int32_t node : cutOf(forest, count)) balls.push_back(forest[node].ball);
    return balls;
}

void dropChildless(TightLevel& level, TightLevel& finer)
{
    std::vector<int32_t> index(level.balls.size(), -1);
    for (const int32_t parent : finer.parent) index[parent] = 0;
    TightLevel kept;
    for (std::size_t b = 0; b < level.balls.size(); ++b) {
        if (index[b] < 0) continue;
        index[b] = int32_t(kept.balls.size());
        kept.balls.push_back(level.balls[b]);
        if (!level.parent.empty()) kept.parent.push_back(level.parent[b]);
    }
    for (int32_t& parent : finer.parent) parent = index[parent];
    level = std::move(kept);
}

void adoptOrphans(TightLevel& finer, const std::vector<ExactSphere>& level)
{
    std::vector<std::size_t> orphans;
    for (std::size_t i = 0; i < finer.balls.size(); ++i) {
        if (level[finer.parent[i]].empty() && !finer.balls[i].empty()) orphans.push_back(i);
    }
    if (orphans.empty()) return;
    const BallGrid grid(level);
    for (const std::size_t i : orphans) finer.parent[i] = anyNear(finer.balls[i], level, grid);
}

int32_t leastProtruding(const ExactSphere& ball, const std::vector<ExactSphere>& level)
{
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < level.size(); ++i) {
        if (level[i].empty()) continue;
        const double reach = protrusion(ball, level[i]);
        if (reach >= least) continue;
        least = reach;
        best = i;
    }
    return int32_t(best);
}

int32_t leastProtruding(
    const ExactSphere& ball, const std::vector<ExactSphere>& level, const BallGrid& grid)
{
    if (grid.size() == 0) return 0;
    constexpr double kRounding = 1;
    const double reach = protrusion(ball, level[std::size_t(anyNear(ball, level, grid))]);
    return leastAmong(grid.near(ball, reach - 2 * ball.radius() + kRounding), ball, level);
}

int32_t anyNear(
    const ExactSphere& ball, const std::vector<ExactSphere>& level, const BallGrid& grid)
{
    constexpr std::size_t kSome = 8;
    constexpr int32_t kNone = -1;
    return leastAmong(grid.nearest(kNone, ball, kSome), ball, level);
}

std::vector<TightLevel> levelsOf(const std::vector<ForestNode>& forest,
    const std::vector<int64_t>& counts, const std::vector<MedialBall>& digital)
{
    std::vector<TightLevel> levels(counts.size());
    for (std::size_t k = counts.size(); k-- > 0;) {
        const std::vector<int32_t> nodes = cutOf(forest, counts[k]);
        levels[k].balls = ballsOfCut(forest, counts[k]);
        if (nodes.size() == digital.size()) levels[k].digital = digital;
        if (k + 1 < counts.size()) {
            levels[k].parent = parentsIn(forest, nodes, counts[k + 1], levels[k + 1].balls);
        }
    }
    return levels;
}

void appendLevels(const std::vector<TightLevel>& levels, SphereTree& tree)
{
    tree.subdivision = int(kFine);
    tree.levels.resize(levels.size());
    std::vector<int32_t> ids;
    for (std::size_t k = levels.size(); k-- > 0;) {
        ids = appendLevel(levels[k], int(k), ids, tree);
    }
}

std::vector<TightLevel> levelsOf(const SphereTree& tree)
{
    const FlatAxis flat(tree.flatAxis);
    std::vector<TightLevel> levels(tree.levels.size());
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const SphereTreeLevel& range = tree.levels[k];
        for (int32_t id = range.begin; id < range.end; ++id) {
            const Vec3d center = flat.toZ(tree.spheres.center[id]) * double(kFine);
            levels[k].balls.push_back(
                {{std::llround(center[0]), std::llround(center[1]), std::llround(center[2])},
                    tree.spheres.coverRadiusSq[id]});
            if (k + 1 == levels.size()) continue;
            levels[k].parent.push_back(tree.spheres.parent[id] - tree.levels[k + 1].begin);
        }
    }
    return levels;
}

SphereCuts cutsOf(const std::vector<ForestNode>& forest, int flatAxis)
{
    const FlatAxis flat(flatAxis);
    SphereCuts cuts;
    for (const ForestNode& node : forest) {
        append(cuts.spheres, node.ball, flat.fromZ(centerOf(node.ball)), node.parent);
        cuts.first.push_back(node.first);
        cuts.last.push_back(node.last);
    }
    return cuts;
}

} // namespace openvdb_spheretree::tight
