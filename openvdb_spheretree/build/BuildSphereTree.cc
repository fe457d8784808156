// SPDX-License-Identifier: Apache-2.0
#include "BuildSphereTree.h"

#include "StoredRadii.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Rounding.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/inner/InnerLevels.h>
#include <openvdb_spheretree/paper/IntersectionDag.h>
#include <openvdb_spheretree/paper/MiniballCenters.h>
#include <openvdb_spheretree/paper/TreeLevels.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>
#include <openvdb_spheretree/tight/TightTree.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/Masks.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/Grid.h>
#include <openvdb/Exceptions.h>

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree {

namespace {

using detail::LevelNodes;

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
    // Twice the centers, and radii beyond the object's own size: four times its extent is enough.
    const auto far = [&](int axis) { return 4 * int64_t(size[axis]); };
    if (settings.dist().lengthSq(far(0), far(1), far(2)) == INT64_MAX) {
        OPENVDB_THROW(openvdb::ValueError,
            "the object '" << info.name << "' is too wide for dist=" << toString(settings.dist())
                           << ": use smaller weights, or larger voxels");
    }
}

/// What a tree says of its object, before it has nodes.
SphereTree withoutNodes(const openvdb::BoolGrid& object, const SphereTreeSettings& settings)
{
    requireUniformVoxels(object);
    SphereTree tree;
    tree.settings = settings;
    tree.object = {object.getName(), int64_t(object.activeVoxelCount()),
        int64_t(object.tree().leafCount()), int64_t(object.tree().activeTileCount()),
        object.evalActiveVoxelBoundingBox()};
    requireValidObject(tree.object, settings);
    tree.flatAxis = settings.dim == 2 ? flatAxisOf(tree.object.bbox) : 2;
    if (const auto* options = settings.find<PyramidOptions>()) tree.hasDag = options->dag;
    if (const auto* options = settings.find<BudgetOptions>()) tree.hasCuts = options->cuts;
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
        [&] { detail::resizeLarge(tree.spheres.parent, count); });
    tree.levels.resize(levels.size());
    const FlatAxis flat(tree.flatAxis);
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
            tree.spheres.parent[id] = nodes.parent.empty() ? -1 : firstAbove + nodes.parent[i];
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
    tbb::parallel_invoke([&] { detail::resizeLarge(tree.spheres.center, count); },
        [&] { detail::resizeLarge(tree.spheres.radius, count); },
        [&] { detail::resizeLarge(tree.spheres.coverRadiusSq, count); });
    const int unit = tree.settings.dist().unit();
    for (const SphereTreeLevel& range : tree.levels) {
        const LevelNodes nodes = std::move(levels[range.level]);
        const LevelFrame frame(range.level, tree.origin, tree.settings, tree.flatAxis);
        detail::parallelFor(std::size_t(range.size()), interrupter, [&](std::size_t i) {
            const std::size_t id = std::size_t(range.begin) + i;
            tree.spheres.center[id] = frame.center(tree.ijk[id]).halved();
            if (nodes.radius.empty()) {
                const RootSum radius = frame.radius(tree.radiusSq[id]);
                tree.spheres.radius[id] = detail::divideUp(radius.radius(), unit);
                tree.spheres.coverRadiusSq[id] = radius.coverSq();
            } else {
                tree.spheres.radius[id] = detail::divideUp(nodes.radius[i], unit);
                tree.spheres.coverRadiusSq[id] = nodes.coverSq[i];
            }
        });
    }
}

/// The trees of the paper, along a pyramid from the object's voxels on.
void appendPyramidTree(SphereTree& tree, openvdb::MaskTree::Ptr voxels, StageSeconds& seconds,
    openvdb::util::NullInterrupter* interrupter)
{
    const PyramidOptions& options = tree.settings.pyramid();
    const FlatAxis flat(tree.flatAxis);
    const detail::BuildContext context{tree.settings, options, flat.toZ(tree.origin),
        flat.toZ(tree.object.bbox), interrupter, &seconds, detail::modelOf(options, interrupter)};
    const bool extended = tree.settings.type() == TreeType::Extended;
    std::vector<LevelNodes> levels = extended
        ? detail::extendedLevels(std::move(voxels), context)
        : detail::reversibleLevels(std::move(voxels), context);
    detail::timed("nodes of the tree", interrupter, &seconds.tree, [&] {
        placeBalls(tree, levels, interrupter);
        measureBalls(tree, std::move(levels), interrupter);
    });
    const bool miniballs = options.center == Center::Miniball;
    if (miniballs) {
        detail::timed("miniballs", interrupter, &seconds.tree,
            [&] { detail::centerOnMiniballs(tree, interrupter); });
    }
    if (options.dag && options.edges == DagEdges::Intersecting) {
        tree.dag = intersectionDag(tree, interrupter);
    }
    detail::timed("stored radii", interrupter, &seconds.tree, [&] {
        detail::storeRadii(tree, interrupter);
        if (extended || miniballs)
            detail::containStoredLeaves(tree, tree.spheres.radius, interrupter);
    });
}

} // namespace

SphereTree buildSphereTree(const openvdb::BoolGrid& object, const SphereTreeSettings& settings,
    StageSeconds* seconds, openvdb::util::NullInterrupter* interrupter)
{
    settings.validate();
    SphereTree tree = withoutNodes(object, settings);
    StageSeconds ownSeconds;
    if (!seconds) seconds = &ownSeconds;
    if (const auto* options = settings.find<TightOptions>()) {
        tight::appendTightTree(tree, object, interrupter, seconds);
        detail::storeRadii(tree, interrupter);
        if (options->cover == Cover::Balls) {
            detail::containStoredLeaves(tree, detail::radiiAroundCut(tree), interrupter);
        }
        return tree;
    }
    auto voxels = voxelsOf(object, FlatAxis(tree.flatAxis));
    if (settings.isInner()) detail::appendInnerTree(tree, *voxels, *seconds, interrupter);
    else appendPyramidTree(tree, std::move(voxels), *seconds, interrupter);
    return tree;
}

} // namespace openvdb_spheretree
