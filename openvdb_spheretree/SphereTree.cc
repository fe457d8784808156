// SPDX-License-Identifier: Apache-2.0
#include "SphereTree.h"

#include "FlatAxis.h"
#include "IntersectionDag.h"
#include "UniformVoxels.h"
#include "detail/InnerLevels.h"
#include "detail/MiniballCenters.h"
#include "detail/RoundUp.h"
#include "detail/StageTimer.h"
#include "detail/TreeLevels.h"
#include "detail/WorldDistance.h"
#include "tight/TightTree.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>

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

/// Nodes of all levels, top level first: ids in the order of the header.
void appendNodes(SphereTree& tree, const std::vector<LevelNodes>& levels)
{
    const FlatAxis flat(tree.settings.flatAxis);
    tree.levels.resize(levels.size());
    for (int level = int(levels.size()) - 1; level >= 0; --level) {
        const LevelNodes& nodes = levels[level];
        const LevelFrame frame(level, tree.origin, tree.settings);
        SphereTreeLevel& range = tree.levels[level];
        const int32_t above = level + 1 < int(levels.size()) ? tree.levels[level + 1].begin : 0;
        range.level = level;
        range.begin = tree.size();
        range.pyramidVoxels = nodes.pyramidVoxels;
        range.topology = nodes.topology;
        for (std::size_t i = 0; i < nodes.balls.size(); ++i) {
            const openvdb::Coord ijk = flat.fromZ(nodes.balls[i].center);
            tree.center.push_back(frame.center(ijk).halved());
            tree.radius.push_back(detail::divideUp(nodes.radius[i], tree.settings.dist.unit()));
            tree.coverSq.push_back(nodes.coverSq[i]);
            tree.parent.push_back(nodes.parent.empty() ? -1 : above + nodes.parent[i]);
            tree.ijk.push_back(ijk);
            tree.radiusSq.push_back(nodes.balls[i].radiusSq);
        }
        range.end = tree.size();
        for (const DagEdge& edge : nodes.dag) {
            tree.dag.push_back({above + edge.parent, range.begin + edge.child});
        }
    }
    std::sort(tree.dag.begin(), tree.dag.end());
}

/// @return radii in world units: padding added, voxels to world units, rounded up to floats.
std::vector<float> storedRadii(const SphereTree& tree, const std::vector<double>& radii)
{
    const double padding = tree.settings.paddingVoxels();
    const double voxel = largestStretch(*tree.transform);
    std::vector<float> stored;
    for (const double radius : radii) {
        const double padded = detail::addUp(radius, padding);
        stored.push_back(detail::toFloatUp(detail::multiplyUp(padded, voxel)));
        if (!std::isfinite(stored.back())) {
            OPENVDB_THROW(openvdb::ValueError,
                "a radius of " << padded << " voxels of " << voxel
                               << " does not fit a float: use another unit of length, or less "
                                  "padding");
        }
    }
    return stored;
}

void storeRadii(SphereTree& tree)
{
    tree.radiusWorld = storedRadii(tree, tree.radius);
    tree.cuts.radiusWorld = storedRadii(tree, tree.cuts.radius);
}

/// Makes stored spheres contain the stored leaf spheres below them: a leaf's radius may have been
/// rounded up by more than its ancestor's, and world-space centres are rounded too.
void containStoredLeaves(SphereTree& tree)
{
    // A world coordinate is a sum of terms, each with a relative error of some 2^-52, in whatever
    // order a reader adds them up; they may be large and cancel out. Distances inherit the error.
    const double voxel = largestStretch(*tree.transform);
    const double moved = tree.transform->indexToWorld(openvdb::Vec3d(0)).length();
    const auto doubt = [&](int32_t id) {
        return 1e-15 * (voxel * tree.center[id].length() + moved);
    };
    const detail::WorldDistance distance(tree);
    const SphereTreeLevel& finest = tree.levels.front();
    for (int32_t leaf = finest.begin; leaf < finest.end; ++leaf) {
        for (int32_t t = tree.parent[leaf]; t >= 0; t = tree.parent[t]) {
            const double apart = distance(leaf, t) * (1 + 1e-14);
            const double needed = apart + doubt(leaf) + doubt(t) + double(tree.radiusWorld[leaf]);
            if (double(tree.radiusWorld[t]) < needed) {
                tree.radiusWorld[t] = detail::toFloatUp(needed);
            }
        }
    }
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
        storeRadii(tree);
        if (settings.cover == Cover::Balls) containStoredLeaves(tree);
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
    appendNodes(tree,
        settings.tree == TreeType::Reversible ? detail::reversibleLevels(voxels, context)
                                              : detail::extendedLevels(voxels, context));
    if (settings.center == Center::Miniball) {
        detail::timed("miniballs", interrupter, &context.seconds->tree,
            [&] { detail::centerOnMiniballs(tree, interrupter); });
    }
    if (settings.dag && settings.edges == DagEdges::Intersecting) {
        tree.dag = intersectionDag(tree, interrupter);
    }
    storeRadii(tree);
    if (containsLeaves(settings)) containStoredLeaves(tree);
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
