// SPDX-License-Identifier: Apache-2.0
#include "DenseTree.h"

#include <algorithm>
#include <limits>

namespace spheretree_test {

DenseTreeBuilder::DenseTreeBuilder(const Voxels& object) : mObject(object)
{
    sortVoxels(mObject);
    const Coord lowest = boxOf(mObject).min();
    for (int axis = 0; axis < 3; ++axis) mOrigin[axis] = 8 * floorOf(lowest[axis] / 8.0);
}

std::vector<DenseLevel> DenseTreeBuilder::build(const DenseSettings& settings)
{
    mSettings = settings;
    mLeaves.clear();
    std::set<Coord> voxels(mObject.begin(), mObject.end());
    const NaiveReference* fine = &medial(voxels);
    std::vector<DenseLevel> levels{firstLevel(*fine)};
    while (levels.back().nodes.size() > 1) {
        const int level = int(levels.size());
        voxels = coarsened(voxels, level);
        const NaiveReference* coarse = &medial(voxels);
        levels.push_back(nextLevel(levels.back(), level, *fine, *coarse));
        if (settings.extended) fitAndRebuild(levels[level], levels[level - 1], level, voxels);
        fine = coarse;
    }
    return levels;
}

Coord DenseTreeBuilder::parentVoxel(const Coord& v, int level) const
{
    Coord parent = level == 1 ? v - mOrigin : v;
    for (int axis = 0; axis < mSettings.dim; ++axis) {
        parent[axis] = floorOf(double(parent[axis]) / mSettings.factor);
    }
    return parent;
}

std::array<double, 3> DenseTreeBuilder::centerOf(const Coord& v, int level) const
{
    std::array<double, 3> center{};
    for (int axis = 0; axis < 3; ++axis) {
        const double scale = axis < mSettings.dim ? scaleOf(level) : 1;
        center[axis] = level == 0 ? v[axis] : scale * v[axis] + (scale - 1) / 2 + mOrigin[axis];
    }
    return center;
}

double DenseTreeBuilder::growthOf(int level) const
{
    const double half = (scaleOf(level) - 1) / 2;
    return distance({0, 0, 0}, {half, half, mSettings.dim == 3 ? half : 0});
}

double DenseTreeBuilder::radiusOf(int64_t radiusSq, int level) const
{
    const bool paper = mSettings.paperScale && level > 0;
    const double covered = paper ? std::sqrt(double(radiusSq)) : closed(radiusSq);
    return scaleOf(level) * covered / std::max(mSettings.norm[0], 1) + growthOf(level);
}

double DenseTreeBuilder::closed(int64_t radiusSq) const
{
    if (!hasNorm()) return std::sqrt(double(radiusSq - 1));
    const auto radius = int(std::lround(std::sqrt(double(radiusSq))));
    std::vector<bool> reached(radius, false); // costs that steps add up to
    reached[0] = true;
    int last = 0;
    for (int cost = 1; cost < radius; ++cost) {
        for (const int step : mSettings.norm) {
            if (step <= cost && reached[cost - step]) reached[cost] = true;
        }
        if (reached[cost]) last = cost;
    }
    return last;
}

double DenseTreeBuilder::distance(
    const std::array<double, 3>& a, const std::array<double, 3>& b) const
{
    std::array<double, 3> d{std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])};
    if (!hasNorm()) return std::hypot(d[0], d[1], d[2]);
    std::sort(d.begin(), d.end());
    const Weights& cost = mSettings.norm;
    return (cost[2] * d[0] + cost[1] * (d[1] - d[0]) + cost[0] * (d[2] - d[1])) / cost[0];
}

const NaiveReference& DenseTreeBuilder::medial(const std::set<Coord>& voxels)
{
    std::unique_ptr<NaiveReference>& known = mMedial[{{mSettings.dim, mSettings.norm}, voxels}];
    if (!known) {
        known = std::make_unique<NaiveReference>(Voxels(voxels.begin(), voxels.end()),
            mSettings.dim, hasNorm() ? Length(mSettings.norm) : Length());
    }
    return *known;
}

Coord DenseTreeBuilder::labelOf(const NaiveReference& medial, const Coord& voxel)
{
    const Voxels& voxels = medial.voxels();
    const auto it = std::lower_bound(voxels.begin(), voxels.end(), voxel);
    return medial.label(std::size_t(it - voxels.begin()));
}

bool DenseTreeBuilder::isOn(const NaiveReference& medial, const Coord& voxel)
{
    return std::binary_search(medial.voxels().begin(), medial.voxels().end(), voxel);
}

DenseLevel DenseTreeBuilder::allBalls(const NaiveReference& medial, int level) const
{
    DenseLevel result;
    result.voxels = medial.voxels();
    for (const NaiveReference::Ball& ball : medial.balls()) {
        const int64_t radiusSq = hasNorm() ? ball.radiusSq * ball.radiusSq : ball.radiusSq;
        result.nodes.push_back(
            {centerOf(ball.center, level), radiusOf(radiusSq, level), -1, ball.center, radiusSq});
    }
    return result;
}

DenseLevel DenseTreeBuilder::firstLevel(const NaiveReference& medial)
{
    DenseLevel level = allBalls(medial, 0);
    for (const DenseNode& node : level.nodes) {
        mLeaves.push_back({node.center, node.radius, int(mLeaves.size())});
    }
    return level;
}

std::set<Coord> DenseTreeBuilder::coarsened(const std::set<Coord>& voxels, int level) const
{
    const CoordBBox box = pyramidBox(level);
    if (mSettings.extended && mSettings.reconstruct == DenseReconstruction::Free
        && box.min() == box.max()) {
        return {box.min()};
    }
    std::set<Coord> result;
    for (const Coord& voxel : voxels) result.insert(parentVoxel(voxel, level));
    return result;
}

CoordBBox DenseTreeBuilder::pyramidBox(int level) const
{
    CoordBBox box = boxOf(mObject);
    for (int k = 1; k <= level; ++k) {
        box = CoordBBox(parentVoxel(box.min(), k), parentVoxel(box.max(), k));
    }
    return box;
}

DenseLevel DenseTreeBuilder::nextLevel(
    DenseLevel& below, int level, const NaiveReference& fine, const NaiveReference& coarse) const
{
    DenseLevel balls = allBalls(coarse, level);
    const std::map<Coord, int> ballAt = indexByCentre(balls);
    below.dag = dagEdges(below, level, fine, coarse, ballAt);
    for (std::size_t i = 0; i < below.nodes.size(); ++i) {
        DenseNode& node = below.nodes[i];
        node.parent = 0;
        if (balls.nodes.size() == 1) continue;
        node.parent = ballAt.at(labelOf(coarse, parentVoxel(node.ijk, level)));
        if (mSettings.parentByDag) preferDagParent(below, int(i), balls, level);
    }
    return mSettings.extended ? withChildren(below, balls) : balls;
}

std::map<Coord, int> DenseTreeBuilder::indexByCentre(const DenseLevel& level)
{
    std::map<Coord, int> result;
    for (const DenseNode& node : level.nodes) result.emplace(node.ijk, int(result.size()));
    return result;
}

std::set<std::pair<int, int>> DenseTreeBuilder::dagEdges(const DenseLevel& below, int level,
    const NaiveReference& fine, const NaiveReference& coarse,
    const std::map<Coord, int>& ballAt) const
{
    const std::map<Coord, int> nodeAt = indexByCentre(below);
    std::set<std::pair<int, int>> edges;
    for (const Coord& voxel : fine.voxels()) {
        const auto child = nodeAt.find(labelOf(fine, voxel));
        const Coord parent = parentVoxel(voxel, level);
        if (child == nodeAt.end() || !isOn(coarse, parent)) continue;
        edges.emplace(ballAt.at(labelOf(coarse, parent)), child->second);
    }
    return edges;
}

void DenseTreeBuilder::preferDagParent(
    DenseLevel& below, int child, const DenseLevel& balls, int level) const
{
    DenseNode& node = below.nodes[child];
    const double own = radiusOf(node.radiusSq, level - 1);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [parent, of] : below.dag) {
        if (of != child) continue;
        const DenseNode& ball = balls.nodes[parent];
        const double power = distance(node.center, ball.center) + own - ball.radius;
        if (power > least - 1e-9) continue; // equal but for rounding
        node.parent = parent;
        least = power;
    }
}

DenseLevel DenseTreeBuilder::withChildren(DenseLevel& below, const DenseLevel& balls)
{
    std::map<int, int> kept;
    for (const DenseNode& node : below.nodes) kept[node.parent] = 0;
    DenseLevel result;
    result.voxels = balls.voxels;
    for (auto& [ball, node] : kept) {
        node = int(result.nodes.size());
        result.nodes.push_back(balls.nodes[ball]);
    }
    for (DenseNode& node : below.nodes) node.parent = kept.at(node.parent);
    std::set<std::pair<int, int>> edges;
    for (const auto& [ball, child] : below.dag) {
        if (kept.count(ball)) edges.emplace(kept.at(ball), child);
    }
    below.dag = edges;
    return result;
}

void DenseTreeBuilder::fitAndRebuild(
    DenseLevel& nodes, const DenseLevel& below, int level, std::set<Coord>& voxels)
{
    for (DenseNode& node : nodes.nodes) node.radius = 0;
    for (Leaf& leaf : mLeaves) {
        leaf.ancestor = below.nodes[leaf.ancestor].parent;
        DenseNode& node = nodes.nodes[leaf.ancestor];
        node.radius = std::max(node.radius, distance(leaf.center, node.center) + leaf.radius);
    }
    const bool done = nodes.nodes.size() == 1;
    if (mSettings.reconstruct != DenseReconstruction::None && !done) {
        voxels = reconstructed(nodes, level);
    }
    if (mSettings.finalFit) return;
    for (DenseNode& node : nodes.nodes) node.radius += growthOf(level);
}

std::set<Coord> DenseTreeBuilder::reconstructed(const DenseLevel& nodes, int level) const
{
    const CoordBBox clip = pyramidBox(level);
    std::set<Coord> voxels;
    for (const DenseNode& node : nodes.nodes) {
        const double limit = node.radius / scaleOf(level) * (1 + 1e-9);
        const int reach = floorOf(limit), reachZ = mSettings.dim == 2 ? 0 : reach;
        const Coord corner(reach, reach, reachZ);
        for (const Coord& v : voxelsOfBox(CoordBBox(node.ijk - corner, node.ijk + corner))) {
            const Coord apart = v - node.ijk;
            const std::array<double, 3> d{double(apart[0]), double(apart[1]), double(apart[2])};
            if (distance(d, {0, 0, 0}) > limit) continue;
            const bool free = mSettings.reconstruct == DenseReconstruction::Free;
            if (free || clip.isInside(v)) voxels.insert(v);
        }
    }
    return voxels;
}

} // namespace spheretree_test
