// SPDX-License-Identifier: Apache-2.0
#include "SphereTree.h"

#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/RoundUp.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/inner/InnerLevels.h>
#include <openvdb_spheretree/paper/IntersectionDag.h>
#include <openvdb_spheretree/paper/MiniballCenters.h>
#include <openvdb_spheretree/paper/TreeLevels.h>
#include <openvdb_spheretree/tight/TightTree.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/Exceptions.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace openvdb_spheretree {

namespace {

using detail::LevelNodes;

ObjectInfo describe(const openvdb::BoolGrid& object)
{
    ObjectInfo info;
    info.name = object.getName();
    info.voxels = int64_t(object.activeVoxelCount());
    info.leaves = int64_t(object.tree().leafCount());
    info.tiles = int64_t(object.tree().activeTileCount());
    info.bbox = object.evalActiveVoxelBoundingBox();
    return info;
}

void requireValidObject(const ObjectInfo& info, const SphereTreeSettings& settings)
{
    if (info.voxels == 0) {
        OPENVDB_THROW(openvdb::ValueError, "the object '" << info.name << "' has no voxels");
    }
    const openvdb::Coord size = info.bbox.extents();
    if (settings.dim == 2 && flatAxisOf(info.bbox) < 0) {
        OPENVDB_THROW(openvdb::ValueError,
            "dim=2 needs an object one voxel thick along an axis, but '"
                << info.name << "' has " << size[0] << " x " << size[1] << " x " << size[2]
                << " voxels: use dim=3");
    }
    // Twice the centres, and radii beyond the object's own size: four times its extent is enough.
    const auto far = [&](int axis) { return 4 * int64_t(size[axis]); };
    if (settings.dist.lengthSq(far(0), far(1), far(2)) == INT64_MAX) {
        OPENVDB_THROW(openvdb::ValueError,
            "the object '" << info.name << "' is too wide for dist=" << toString(settings.dist)
                           << ": use smaller weights, or larger voxels");
    }
}

/// What a tree says of its object, before it has nodes.
SphereTree withoutNodes(const openvdb::BoolGrid& object, const SphereTreeSettings& settings)
{
    requireUniformVoxels(object);
    SphereTree tree;
    tree.settings = settings;
    tree.settings.hadCustomModel = bool(settings.customModel);
    tree.object = describe(object);
    requireValidObject(tree.object, settings);
    tree.settings.flatAxis = settings.dim == 2 ? flatAxisOf(tree.object.bbox) : 2;
    tree.origin = pyramidOrigin(tree.object.bbox);
    tree.transform = object.transform().copy();
    return tree;
}

/// The digital balls of all levels and their parents, top level first: ids in the order of the
/// header. Balls are given back as they are copied, since there may be gigabytes of them.
void placeBalls(
    SphereTree& tree, std::vector<LevelNodes>& levels, openvdb::util::NullInterrupter* interrupter)
{
    std::size_t count = 0;
    for (const LevelNodes& nodes : levels) count += nodes.balls.size();
    detail::requireRoomForNodes(count);
    tbb::parallel_invoke([&] { detail::resizeLarge(tree.ijk, count); },
        [&] { detail::resizeLarge(tree.radiusSq, count); },
        [&] { detail::resizeLarge(tree.parent, count); });
    tree.levels.resize(levels.size());
    const FlatAxis flat(tree.settings.flatAxis);
    int32_t begin = 0, firstAbove = 0;
    for (int level = int(levels.size()) - 1; level >= 0; --level) {
        LevelNodes& nodes = levels[level];
        SphereTreeLevel& range = tree.levels[level];
        range.level = level;
        range.begin = begin;
        range.end = begin + int32_t(nodes.balls.size());
        range.pyramidVoxels = nodes.pyramidVoxels;
        range.topology = nodes.topology;
        detail::parallelFor(nodes.balls.size(), interrupter, [&](std::size_t i) {
            const std::size_t id = std::size_t(begin) + i;
            tree.ijk[id] = flat.fromZ(nodes.balls[i].center);
            tree.radiusSq[id] = nodes.balls[i].radiusSq;
            tree.parent[id] = nodes.parent.empty() ? -1 : firstAbove + nodes.parent[i];
        });
        for (const DagEdge& edge : nodes.dag) {
            tree.dag.push_back({firstAbove + edge.parent, range.begin + edge.child});
        }
        std::vector<MedialBall>().swap(nodes.balls);
        std::vector<int32_t>().swap(nodes.parent);
        std::vector<DagEdge>().swap(nodes.dag);
        firstAbove = range.begin;
        begin = range.end;
    }
    std::sort(tree.dag.begin(), tree.dag.end());
}

/// Where the balls are in the frame of level 0, and how large. Levels are used up.
void measureBalls(
    SphereTree& tree, std::vector<LevelNodes> levels, openvdb::util::NullInterrupter* interrupter)
{
    const std::size_t count = tree.ijk.size();
    tbb::parallel_invoke([&] { detail::resizeLarge(tree.center, count); },
        [&] { detail::resizeLarge(tree.radius, count); },
        [&] { detail::resizeLarge(tree.coverSq, count); });
    const int unit = tree.settings.dist.unit();
    for (const SphereTreeLevel& range : tree.levels) {
        const LevelNodes nodes = std::move(levels[range.level]);
        const LevelFrame frame(range.level, tree.origin, tree.settings);
        detail::parallelFor(std::size_t(range.size()), interrupter, [&](std::size_t i) {
            const std::size_t id = std::size_t(range.begin) + i;
            tree.center[id] = frame.center(tree.ijk[id]).halved();
            if (nodes.radius.empty()) {
                const RootSum radius = frame.radius(tree.radiusSq[id]);
                tree.radius[id] = detail::divideUp(radius.radius(), unit);
                tree.coverSq[id] = radius.coverSq();
            } else {
                tree.radius[id] = detail::divideUp(nodes.radius[i], unit);
                tree.coverSq[id] = nodes.coverSq[i];
            }
        });
    }
}

/// @return a radius in world units, rounded up to a float.
float storedRadius(double radius)
{
    const float stored = detail::toFloatUp(radius);
    if (std::isfinite(stored)) return stored;
    OPENVDB_THROW(openvdb::ValueError,
        "a radius of " << radius
                       << " world units does not fit a float: use another unit of length, or less "
                          "padding");
}

/// @return radii in world units: padding added, voxels to world units, rounded up to floats.
std::vector<float> storedRadii(const SphereTree& tree, const std::vector<double>& radii,
    openvdb::util::NullInterrupter* interrupter)
{
    const double padding = tree.settings.paddingVoxels();
    const double voxel = largestStretch(*tree.transform);
    std::vector<float> stored;
    detail::resizeLarge(stored, radii.size());
    detail::parallelFor(radii.size(), interrupter, [&](std::size_t i) {
        const double padded = detail::addUp(radii[i], padding);
        stored[i] = storedRadius(detail::multiplyUp(padded, voxel));
    });
    return stored;
}

void storeRadii(SphereTree& tree, openvdb::util::NullInterrupter* interrupter)
{
    tree.radiusWorld = storedRadii(tree, tree.radius, interrupter);
    tree.cuts.radiusWorld = storedRadii(tree, tree.cuts.radius, interrupter);
}

/// How much larger than its radius a node's stored sphere is made, to contain the stored leaf
/// spheres below it, which were rounded up too, and centres in the world are rounded: about two
/// units in a float's last place. To search for the leaf that decides took longer than all else
/// that is done to radii.
class StoredSlack {
public:
    StoredSlack(const SphereTree& tree, openvdb::util::NullInterrupter* interrupter)
        : mVoxel(largestStretch(*tree.transform)), mPadding(tree.settings.paddingVoxels())
    {
        const SphereTreeLevel& leaves = tree.levels.front();
        Most most = tbb::parallel_reduce(
            tbb::blocked_range<int32_t>(leaves.begin, leaves.end), Most(),
            [&](const tbb::blocked_range<int32_t>& range, Most result) {
                for (int32_t id = range.begin(); id < range.end(); ++id) {
                    const openvdb::Vec3d& c = tree.center[id];
                    const double away = std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]);
                    const double excess = double(tree.radiusWorld[id]) - world(tree.radius[id]);
                    result = larger(result, {excess, away});
                }
                return result;
            },
            larger);
        detail::checkInterrupt(interrupter);
        const double moved = tree.transform->indexToWorld(openvdb::Vec3d(0)).length();
        mExcess = most.excess;
        mDoubt = 16 * kUnit * (mVoxel * most.away + moved);
    }

    /// @param radius  that contains the leaf balls below, in voxels
    /// @return a radius for the stored sphere.
    float radius(double radius) const
    {
        // A float is rounded up by no more than 2^-23 of it, a leaf ball's is not the larger one.
        const double exact = world(radius);
        const double excess = std::min(mExcess, exact * 0x1p-23 + kLeastFloat);
        return storedRadius((exact + excess + mDoubt) * (1 + kRounding));
    }

private:
    struct Most {
        double excess = 0, away = 0;
    };
    static Most larger(const Most& a, const Most& b)
    {
        return {std::max(a.excess, b.excess), std::max(a.away, b.away)};
    }
    double world(double radius) const { return (radius + mPadding) * mVoxel; }

    // A world coordinate is a sum of terms, each with a relative error of some 2^-52, in whatever
    // order a reader adds them up; they may be large and cancel out. Distances inherit the error.
    static constexpr double kUnit = 1e-15;
    static constexpr double kRounding = 1e-12; // more than that of all terms here
    static constexpr double kLeastFloat = 0x1p-149;

    const double mVoxel, mPadding;
    double mExcess = 0; ///< of a leaf's stored radius over what it stands for
    double mDoubt = 0;  ///< of distances in the world, of any two centres
};

/// Makes stored spheres contain the stored leaf spheres below them.
/// @param radii  of nodes: they contain the leaf balls below; of leaves, they do not matter
void containStoredLeaves(
    SphereTree& tree, const std::vector<double>& radii, openvdb::util::NullInterrupter* interrupter)
{
    const StoredSlack slack(tree, interrupter);
    const int32_t leaves = tree.levels.front().begin;
    detail::parallelFor(std::size_t(leaves), interrupter, [&](std::size_t id) {
        tree.radiusWorld[id] = std::max(tree.radiusWorld[id], slack.radius(radii[id]));
    });
}

/// The radii of a tight tree that contain the balls of its level 0, which may be a cut: nodes were
/// made to contain the leaves below it. Such trees are small.
std::vector<double> radiiAroundCut(const SphereTree& tree)
{
    const Distance& distance = tree.settings.dist;
    std::vector<double> radii = tree.radius;
    const SphereTreeLevel& cut = tree.levels.front();
    for (int32_t id = cut.begin; id < cut.end; ++id) {
        for (int32_t t = tree.parent[id]; t >= 0; t = tree.parent[t]) {
            const openvdb::Vec3d d = tree.center[t] - tree.center[id];
            const double apart = distance.length(d[0], d[1], d[2]) / distance.unit();
            radii[t] = std::max(radii[t], apart + tree.radius[id]);
        }
    }
    return radii;
}

/// Whether every node contains the leaf balls below it.
bool containsLeaves(const SphereTreeSettings& settings)
{
    return settings.tree == TreeType::Extended || settings.center == Center::Miniball;
}

} // namespace

int SphereTree::levelOf(int32_t id) const
{
    for (const SphereTreeLevel& range : levels) {
        if (id >= range.begin && id < range.end) return range.level;
    }
    OPENVDB_THROW(openvdb::LookupError, "the tree has no node " << id);
}

SphereTree buildSphereTree(const openvdb::BoolGrid& object, const SphereTreeSettings& settings,
    openvdb::util::NullInterrupter* interrupter, BuildSeconds* seconds)
{
    settings.validate();
    SphereTree tree = withoutNodes(object, settings);
    BuildSeconds ownSeconds;
    if (!seconds) seconds = &ownSeconds;
    const bool inner = settings.side == Side::Inner;
    if (settings.tree == TreeType::Tight && !inner) {
        tight::appendTightTree(tree, object, interrupter, seconds);
        storeRadii(tree, interrupter);
        if (settings.cover == Cover::Balls) {
            containStoredLeaves(tree, radiiAroundCut(tree), interrupter);
        }
        return tree;
    }
    const FlatAxis flat(tree.settings.flatAxis);
    SphereTreeSettings turned = settings;
    turned.flatAxis = 2;
    const detail::BuildContext context{turned, flat.toZ(tree.origin), flat.toZ(tree.object.bbox),
        interrupter, seconds, detail::modelOf(settings, interrupter)};
    auto voxels = flat.toZ(
        std::make_shared<openvdb::MaskTree>(object.tree(), false, openvdb::TopologyCopy()));
    if (inner) {
        detail::appendInnerTree(tree, *voxels, context);
        return tree;
    }
    std::vector<LevelNodes> levels = settings.tree == TreeType::Reversible
        ? detail::reversibleLevels(std::move(voxels), context)
        : detail::extendedLevels(std::move(voxels), context);
    detail::timed("nodes of the tree", interrupter, &context.seconds->tree, [&] {
        placeBalls(tree, levels, interrupter);
        measureBalls(tree, std::move(levels), interrupter);
    });
    if (settings.center == Center::Miniball) {
        detail::timed("miniballs", interrupter, &context.seconds->tree,
            [&] { detail::centerOnMiniballs(tree, interrupter); });
    }
    if (settings.dag && settings.edges == DagEdges::Intersecting) {
        tree.dag = intersectionDag(tree, interrupter);
    }
    detail::timed("stored radii", interrupter, &context.seconds->tree, [&] {
        storeRadii(tree, interrupter);
        if (containsLeaves(settings)) containStoredLeaves(tree, tree.radius, interrupter);
    });
    return tree;
}

SphereTree keepLevel(const SphereTree& tree, int level)
{
    const auto range = std::find_if(tree.levels.begin(), tree.levels.end(),
        [&](const SphereTreeLevel& r) { return r.level == level; });
    if (range == tree.levels.end()) {
        OPENVDB_THROW(openvdb::ValueError,
            "the tree has no level " << level << ": it has levels " << tree.levels.front().level
                                     << " to " << tree.levels.back().level);
    }
    const auto slice = [&](const auto& all) {
        using Array = std::decay_t<decltype(all)>;
        return Array(all.begin() + range->begin, all.begin() + range->end);
    };
    SphereTree result;
    result.center = slice(tree.center);
    result.radius = slice(tree.radius);
    result.coverSq = slice(tree.coverSq);
    result.radiusWorld = slice(tree.radiusWorld);
    result.ijk = slice(tree.ijk);
    result.radiusSq = slice(tree.radiusSq);
    result.parent.assign(result.center.size(), -1);
    result.levels = {*range};
    result.levels[0].begin = 0;
    result.levels[0].end = result.size();
    result.subdivision = tree.subdivision;
    result.settings = tree.settings;
    result.settings.dag = result.settings.cuts = false; // edges lead from level to level
    result.object = tree.object;
    result.origin = tree.origin;
    result.transform = tree.transform->copy();
    return result;
}

} // namespace openvdb_spheretree
