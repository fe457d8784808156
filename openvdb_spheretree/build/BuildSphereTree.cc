// SPDX-License-Identifier: Apache-2.0
#include "BuildSphereTree.h"

#include "ObjectLimits.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/ParallelSort.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/inner/InnerLevels.h>
#include <openvdb_spheretree/nearest/NearestLevels.h>
#include <openvdb_spheretree/paper/IntersectionDag.h>
#include <openvdb_spheretree/paper/MiniballCenters.h>
#include <openvdb_spheretree/paper/TreeLevels.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>
#include <openvdb_spheretree/tight/TightTree.h>
#include <openvdb_spheretree/tree/GivenTree.h>
#include <openvdb_spheretree/tree/SphereTracks.h>
#include <openvdb_spheretree/tree/StoredRadii.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/Masks.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/Grid.h>
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

/// What a tree says of its object, before it has nodes.
SphereTree withoutNodes(const openvdb::BoolGrid& object, const SphereTreeSettings& settings)
{
    requireUniformVoxels(object);
    SphereTree tree;
    tree.settings = settings;
    tree.object = {object.getName(), int64_t(object.activeVoxelCount()),
        int64_t(object.tree().leafCount()), int64_t(object.tree().activeTileCount()),
        object.evalActiveVoxelBoundingBox()};
    tree.origin = detail::requireValidObject(tree.object, settings);
    detail::requireRoomForNodes(object);
    tree.flatAxis = settings.dim == 2 ? flatAxisOf(tree.object.bbox) : 2;
    if (const auto* options = settings.find<PyramidOptions>()) tree.hasDag = options->dag;
    if (const auto* options = settings.find<BudgetOptions>()) tree.hasCuts = options->cuts;
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
    detail::parallelSort(tree.dag.begin(), tree.dag.end(), interrupter);
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

/// Makes stored spheres contain the stored leaf spheres below them.
///
/// Stored leaf spheres were rounded up, and centers in the world are rounded. So a node's stored
/// sphere is made larger than its radius by about two units in a float's last place, which is
/// enough for any leaf. (To search for the leaf that decides took longer than all else that is done
/// to radii.)
/// @param radii  of nodes, in voxels: they contain the leaf balls below; not read of leaves
void containStoredLeaves(
    SphereTree& tree, const std::vector<double>& radii, openvdb::util::NullInterrupter* interrupter)
{
    // A world coordinate is a sum of terms, each with a relative error of some 2^-52, in whatever
    // order a reader adds them up; they may be large and cancel out. Distances inherit the error.
    constexpr double kUnit = 1e-15;
    constexpr double kRounding = 1e-12; // more than that of all terms here
    constexpr double kLeastFloat = 0x1p-149;
    const double voxel = largestStretch(*tree.transform);
    const double padding = tree.settings.paddingVoxels();
    const auto world = [&](double radius) { return (radius + padding) * voxel; };

    struct Most {
        double excess = 0; // of a leaf's stored radius over what it stands for
        double away = 0;   // of a leaf's center from voxel 0
    };
    const auto larger = [](const Most& a, const Most& b) -> Most {
        return {std::max(a.excess, b.excess), std::max(a.away, b.away)};
    };
    const SphereTreeLevel& leaves = tree.levels.front();
    const Most most = tbb::parallel_reduce(
        tbb::blocked_range<int32_t>(leaves.begin, leaves.end), Most(),
        [&](const tbb::blocked_range<int32_t>& range, Most result) {
            for (int32_t id = range.begin(); id < range.end(); ++id) {
                const openvdb::Vec3d& c = tree.spheres.center[id];
                const double away = std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]);
                const double excess =
                    double(tree.spheres.radiusWorld[id]) - world(tree.spheres.radius[id]);
                result = larger(result, {excess, away});
            }
            return result;
        },
        larger);
    detail::checkInterrupt(interrupter);
    const double moved = tree.transform->indexToWorld(openvdb::Vec3d(0)).length();
    const double doubt = 16 * kUnit * (voxel * most.away + moved); // of distances in the world

    detail::parallelFor(std::size_t(leaves.begin), interrupter, [&](std::size_t id) {
        // A float is rounded up by no more than 2^-23 of it, a leaf ball's is not the larger one.
        const double exact = world(radii[id]);
        const double excess = std::min(most.excess, exact * 0x1p-23 + kLeastFloat);
        const float stored = detail::toStoredRadius((exact + excess + doubt) * (1 + kRounding));
        tree.spheres.radiusWorld[id] = std::max(tree.spheres.radiusWorld[id], stored);
    });
}

/// @return radii, in voxels, with which the nodes of a tight tree contain the balls of level 0
///         below them. (Level 0 may be a cut; nodes were made to contain the leaves below the cut.)
///         Such trees are small.
std::vector<double> radiiAroundCut(const SphereTree& tree)
{
    const Distance& distance = tree.settings.dist();
    std::vector<double> radii = tree.spheres.radius;
    const SphereTreeLevel& cut = tree.levels.front();
    for (int32_t id = cut.begin; id < cut.end; ++id) {
        for (int32_t t = tree.spheres.parent[id]; t >= 0; t = tree.spheres.parent[t]) {
            const openvdb::Vec3d d = tree.spheres.center[t] - tree.spheres.center[id];
            const double apart = distance.length(d[0], d[1], d[2]) / distance.unit();
            radii[t] = std::max(radii[t], apart + tree.spheres.radius[id]);
        }
    }
    return radii;
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
        if (extended || miniballs) containStoredLeaves(tree, tree.spheres.radius, interrupter);
    });
}

SphereTree tightTree(SphereTree tree, const openvdb::BoolGrid& object,
    const tight::TightStart& start, StageSeconds& seconds,
    openvdb::util::NullInterrupter* interrupter)
{
    tight::appendTightTree(tree, object, start, interrupter, &seconds);
    detail::storeRadii(tree, interrupter);
    if (tree.settings.tight().cover == Cover::Balls) {
        containStoredLeaves(tree, radiiAroundCut(tree), interrupter);
    }
    return tree;
}

bool hasGivenLeaves(const SphereTreeSettings& settings)
{
    const auto* options = settings.find<TightOptions>();
    return options && options->leaves == Leaves::Given;
}

/// @param last  the tree of the frame before, or null
SphereTree builtTree(const openvdb::BoolGrid& object, const SphereTreeSettings& settings,
    const SphereTree* last, StageSeconds& seconds, openvdb::util::NullInterrupter* interrupter)
{
    settings.validate();
    if (hasGivenLeaves(settings)) {
        OPENVDB_THROW(openvdb::ValueError,
            "leaves=given is for spheres that come from elsewhere: give them to "
            "buildSphereTreeOver()");
    }
    if (settings.isGiven()) {
        OPENVDB_THROW(
            openvdb::ValueError, "tree=given is for spheres that were read: nothing builds them");
    }
    SphereTree tree = withoutNodes(object, settings);
    if (settings.find<TightOptions>()) {
        return tightTree(std::move(tree), object, {/*given=*/nullptr, last}, seconds, interrupter);
    }
    auto voxels = voxelsOf(object, FlatAxis(tree.flatAxis));
    if (settings.isInner()) detail::appendInnerTree(tree, *voxels, seconds, interrupter);
    else if (settings.isFit()) nearest::appendNearestTree(tree, *voxels, seconds, interrupter);
    else appendPyramidTree(tree, std::move(voxels), seconds, interrupter);
    return tree;
}

} // namespace

SphereTree buildSphereTree(const openvdb::BoolGrid& object, const SphereTreeSettings& settings,
    StageSeconds* seconds, openvdb::util::NullInterrupter* interrupter)
{
    StageSeconds ownSeconds;
    return builtTree(object, settings, nullptr, seconds ? *seconds : ownSeconds, interrupter);
}

SphereTree buildNextSphereTree(const SphereTree& last, const openvdb::BoolGrid& object,
    const SphereTreeSettings& settings, StageSeconds* seconds,
    openvdb::util::NullInterrupter* interrupter)
{
    StageSeconds ownSeconds;
    SphereTree tree =
        builtTree(object, settings, &last, seconds ? *seconds : ownSeconds, interrupter);
    continueTracks(tree, last, interrupter);
    return tree;
}

SphereTree buildSphereTreeOver(const WorldSpheres& leaves, const openvdb::BoolGrid& object,
    const SphereTreeSettings& settings, StageSeconds* seconds,
    openvdb::util::NullInterrupter* interrupter)
{
    settings.validate();
    if (!hasGivenLeaves(settings)) {
        OPENVDB_THROW(openvdb::ValueError,
            "spheres that come from elsewhere are the leaves of a tight tree: set leaves=given");
    }
    StageSeconds ownSeconds;
    const SphereTree given = givenTree(leaves, object);
    return tightTree(withoutNodes(object, settings), object, {&given, /*last=*/nullptr},
        seconds ? *seconds : ownSeconds, interrupter);
}

SphereTree buildSphereTreeFrom(const TreeStart& start, const openvdb::BoolGrid& object,
    const SphereTreeSettings& settings, StageSeconds* seconds,
    openvdb::util::NullInterrupter* interrupter)
{
    if (!start.leaves) {
        return start.last ? buildNextSphereTree(*start.last, object, settings, seconds, interrupter)
                          : buildSphereTree(object, settings, seconds, interrupter);
    }
    SphereTree tree = buildSphereTreeOver(*start.leaves, object, settings, seconds, interrupter);
    if (start.last) continueTracks(tree, *start.last, interrupter);
    return tree;
}

} // namespace openvdb_spheretree
