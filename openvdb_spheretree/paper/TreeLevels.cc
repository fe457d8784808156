// SPDX-License-Identifier: Apache-2.0
#include "TreeLevels.h"

#include "SphereDag.h"
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/pyramid/Closing.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace openvdb_spheretree::detail {

void requireRoomForNodes(std::size_t nodes)
{
    constexpr std::size_t kMost = std::numeric_limits<int32_t>::max();
    const std::string what = "the " + std::to_string(nodes) + " spheres of the tree";
    if (nodes > kMost) {
        OPENVDB_THROW(openvdb::ValueError,
            what << " are more than the " << kMost
                 << " that it can have: use a larger voxel, or split the object");
    }
    constexpr std::size_t kNode = sizeof(openvdb::Vec3d) + sizeof(double) + sizeof(int64_t)
        + sizeof(float) + sizeof(int32_t) + sizeof(openvdb::Coord) + sizeof(int32_t);
    requireMemory(double(nodes) * kNode, what, "use a larger voxel, or split the object");
}

bool needsDag(const PyramidOptions& options)
{
    return options.parent == ParentRule::Dag || (options.dag && options.edges == DagEdges::Shared);
}

namespace {

/// Among a node's parents in the DAG, the one of least covering power: the distance by which the
/// node sticks out of it, both as spheres in the frame of level 0. A node without an edge (it
/// labels no voxel whose parent is on) keeps the parent it has.
void preferDagParents(std::vector<int32_t>& parent, const std::vector<DagEdge>& edges,
    const LevelNodes& nodes, int level, const MedialLevel& coarse, const BuildContext& context)
{
    const LevelFrame fineFrame = context.frame(level), coarseFrame = context.frame(level + 1);
    std::vector<double> least(nodes.balls.size(), std::numeric_limits<double>::infinity());
    for (const DagEdge& edge : edges) { // by parent, so that of equals the first parent stays
        const MedialBall& s = nodes.balls[edge.child];
        const MedialBall& t = coarse.balls[edge.parent];
        const double apart = 0.5
            * std::sqrt(double(distanceSq(fineFrame.center(s.center), coarseFrame.center(t.center),
                context.settings.dist())));
        const double power =
            apart + fineFrame.radius(s.radiusSq).radius() - coarseFrame.radius(t.radiusSq).radius();
        if (power >= least[edge.child]) continue;
        least[edge.child] = power;
        parent[edge.child] = edge.parent;
    }
}

} // namespace

std::optional<LevelTopology> topologyOf(const MedialLevel& level, const BuildContext& context)
{
    if (!context.settings.topology) return std::nullopt;
    return timed("topology", context.interrupter, &context.seconds->topology,
        [&] { return levelTopology(level.layout, context.interrupter); });
}

PyramidModel modelOf(const PyramidOptions& options, openvdb::util::NullInterrupter* interrupter)
{
    if (isUnknown(options.customModel)) options.customModel({}, {}); // which says so
    if (options.customModel) return options.customModel;
    return options.closing > 0 ? closingModel(options.closing, interrupter) : PyramidModel();
}

std::unique_ptr<MedialLevel> BuildContext::medialLevel(
    const openvdb::MaskTree& voxels, int level, const LevelNodes* children) const
{
    LevelQueries queries;
    queries.allLabels = needsDag(options);
    queries.memory = settings.memory;
    if (children) {
        queries.count = children->balls.size();
        queries.voxel = [step = stepFrom(level - 1), &balls = children->balls](
                            std::size_t i) { return step.parentVoxel(balls[i].center); };
    }
    return std::make_unique<MedialLevel>(
        voxels, settings.dim, settings.dist(), interrupter, seconds, queries);
}

LevelNodes BuildContext::allBalls(std::unique_ptr<MedialLevel>& level) const
{
    requireRoomForNodes(level->balls.size());
    LevelNodes nodes;
    nodes.pyramidVoxels = level->layout.voxelCount();
    nodes.topology = topologyOf(*level, *this);
    if (needsDag(options)) {
        nodes.balls = level->balls;
    } else {
        nodes.balls = std::move(level->balls);
        level.reset();
    }
    return nodes;
}

openvdb::MaskTree::Ptr BuildContext::coarsened(const openvdb::MaskTree& voxels, int level) const
{
    if (!model) return coarsen(voxels, stepFrom(level), interrupter);
    const int64_t nextScale = frame(level).scale() * options.factor;
    if (options.customModel && nextScale > LevelFrame::kMaxScale) {
        OPENVDB_THROW(openvdb::ValueError,
            "the tree does not end: level "
                << level << " still has several spheres, since the pyramid model adds voxels as "
                << "fast as levels shrink");
    }
    const openvdb::MaskTree::Ptr result = nextLevel(voxels, stepFrom(level), model, interrupter);
    openvdb::CoordBBox box;
    result->evalActiveVoxelBoundingBox(box);
    // Levels may grow by a model as far as a level's frame can measure, and as -check accepts.
    const int64_t scale = frame(level + 1).scale();
    for (int axis = 0; axis < settings.dim; ++axis) {
        const int64_t side = int64_t(box.max()[axis]) - box.min()[axis] + 1;
        const int64_t extent = int64_t(bbox.max()[axis]) - bbox.min()[axis] + 1;
        const int64_t most = std::min(4 * extent + 32 * scale, LevelFrame::kMaxScale);
        if (side * scale <= std::max(most, extent + 2 * scale)) continue; // the latter: as OR's
        OPENVDB_THROW(openvdb::ValueError,
            "the pyramid model grows level "
                << level + 1 << " to " << side << " voxels of " << scale << " along "
                << "xyz"[axis] << ", too far from an object of " << extent
                << ": let it add fewer voxels");
    }
    return result;
}

Links linkLevels(const LevelNodes& nodes, int level, const MedialLevel* fine, MedialLevel& coarse,
    const BuildContext& context)
{
    // The paper's rule: the label of the parent voxel of the ball's center. A single ball is
    // everybody's parent, also of nodes whose parent voxel is off (possible on the last level
    // without the clip).
    Links links{std::move(coarse.queriedLabel), {}};
    auto& [parent, dag] = links;
    if (coarse.balls.size() == 1) std::fill(parent.begin(), parent.end(), 0);
    if (std::find(parent.begin(), parent.end(), -1) != parent.end()) {
        OPENVDB_THROW(openvdb::LookupError, "the parent voxel of a node is not in the level above");
    }
    if (!needsDag(context.options)) return links;
    // Edges between balls of both levels become edges between coarser balls and nodes.
    std::vector<int32_t> nodeOfBall(fine->balls.size(), -1);
    for (std::size_t i = 0; i < nodes.balls.size(); ++i) {
        nodeOfBall[fine->ballAt(nodes.balls[i].center)] = int32_t(i);
    }
    dag = sphereDag(*fine, coarse, context.stepFrom(level), context.interrupter);
    for (DagEdge& edge : dag) edge.child = nodeOfBall[edge.child];
    const auto isNoNode = [](const DagEdge& edge) { return edge.child < 0; };
    dag.erase(std::remove_if(dag.begin(), dag.end(), isNoNode), dag.end());
    if (context.options.parent == ParentRule::Dag) {
        preferDagParents(parent, dag, nodes, level, coarse, context);
    }
    if (!context.options.dag || context.options.edges != DagEdges::Shared) dag.clear();
    return links;
}

} // namespace openvdb_spheretree::detail
