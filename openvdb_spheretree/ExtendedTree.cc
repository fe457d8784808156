// SPDX-License-Identifier: Apache-2.0
/// @file ExtendedTree.cc
/// @brief The extended tree (Broutta et al. 2009, Algorithm 2 and Section 4.2): every sphere
/// contains the leaf balls below it.
///
/// Level 0 is the medial balls of the object. Then, from each level to the one above:
/// 1. `nextVoxels`: coarsen the level's voxels by the pyramid model; take their medial balls and
///    labels; every node's parent is the label of the parent voxel of its centre (`linkLevels`);
/// 2. `keepParents`: a ball without children is dropped;
/// 3. `fitRadii`: a kept ball's radius R is the largest |C_s - C_t| + R_s over the leaf balls s
///    below it; it may be smaller than the medial ball it came from;
/// 4. `reconstruct`: the level's voxels become those within R of a kept centre. They are clipped to
///    the box of the object's own pyramid level: the paper's images have borders, and without the
///    clip levels swell from step to step (Al.100: 630 % error with 9 spheres, against 419 % with
///    12).
///
/// It ends: the clip box of the pyramid's last level is one voxel. Without the clip (`free`), all
/// nodes left at that level get one parent there. Closings stay in the box; where a custom model
/// leaves it, the box grows to what the model made, so that kept centres stay on, and a model that
/// never lets the levels shrink to one ball is an error. Radii come from leaf balls and centres
/// alone, so every level covers the object whatever the model. Radii are integers under square
/// roots (LevelFrame.h). Cost: linear in the voxels of all levels, and leaves x levels for the
/// radii. Tests: TestExtendedTree.cc; golden counts and errors in tests/golden.

#include "SphereUnion.h"
#include "detail/Parallel.h"
#include "detail/StageTimer.h"
#include "detail/TreeLevels.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace openvdb_spheretree {
namespace detail {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskTree;

/// The leaf balls, and the node of the current level above each of them.
struct Leaves {
    std::vector<Doubled> center;
    std::vector<RootSum> radius;
    std::vector<int32_t> ancestor;
};

LevelNodes leafNodes(const MedialLevel& medial, const LevelFrame& frame, Leaves& leaves)
{
    LevelNodes nodes;
    nodes.balls = medial.balls;
    nodes.pyramidVoxels = medial.layout.voxelCount();
    for (const MedialBall& ball : nodes.balls) {
        leaves.center.push_back(frame.center(ball.center));
        leaves.radius.push_back(frame.radius(ball.radiusSq));
        nodes.radius.push_back(leaves.radius.back().radius());
        nodes.coverSq.push_back(leaves.radius.back().coverSq());
    }
    leaves.ancestor.resize(nodes.balls.size());
    std::iota(leaves.ancestor.begin(), leaves.ancestor.end(), 0);
    return nodes;
}

/// @return the balls of @a coarse that have children; @a links become links to these.
LevelNodes keepParents(Links& links, const MedialLevel& coarse)
{
    std::vector<int32_t> nodeOfBall(coarse.balls.size(), -1);
    for (const int32_t ball : links.parent) nodeOfBall[ball] = 0;
    LevelNodes kept;
    kept.pyramidVoxels = coarse.layout.voxelCount();
    for (std::size_t ball = 0; ball < nodeOfBall.size(); ++ball) {
        if (nodeOfBall[ball] < 0) continue;
        nodeOfBall[ball] = int32_t(kept.balls.size());
        kept.balls.push_back(coarse.balls[ball]);
    }
    for (int32_t& parent : links.parent) parent = nodeOfBall[parent];
    std::vector<DagEdge> dag;
    for (const DagEdge& edge : links.dag) {
        const int32_t parent = nodeOfBall[edge.parent];
        if (parent >= 0) dag.push_back({parent, edge.child});
    }
    links.dag = std::move(dag);
    return kept;
}

/// The largest of some sums of two roots for each node, exactly. Roots of doubles tell nearly always
/// which of two sums is the larger: exact arithmetic is for those that may be.
class LargestSums {
public:
    explicit LargestSums(std::size_t nodes)
        : mNearly(nodes, 0), mRadius(nodes, 0), mCoverSq(nodes, 0)
    {}

    void add(std::size_t node, const RootSum& sum, double nearly)
    {
        constexpr double kDoubt = 1e-12; // of a root, and of a sum, 1e-15
        if (nearly < mNearly[node] * (1 - kDoubt)) return;
        mNearly[node] = std::max(mNearly[node], nearly);
        mRadius[node] = std::max(mRadius[node], sum.radius());
        mCoverSq[node] = std::max(mCoverSq[node], sum.coverSq());
    }
    void addTo(LevelNodes& nodes) const
    {
        for (std::size_t t = 0; t < mRadius.size(); ++t) {
            nodes.radius[t] = std::max(nodes.radius[t], mRadius[t]);
            nodes.coverSq[t] = std::max(nodes.coverSq[t], mCoverSq[t]);
        }
    }

private:
    std::vector<double> mNearly; ///< twice the radius
    std::vector<double> mRadius;
    std::vector<int64_t> mCoverSq;
};

/// The smallest radii, around the nodes' own centres, that contain the leaf balls below them.
void fitRadii(
    LevelNodes& nodes, const Leaves& leaves, const LevelFrame& frame, const BuildContext& context)
{
    std::vector<Doubled> center;
    for (const MedialBall& ball : nodes.balls) center.push_back(frame.center(ball.center));
    tbb::enumerable_thread_specific<LargestSums> sums(nodes.balls.size());
    parallelFor(leaves.center.size(), context.interrupter, [&](std::size_t s) {
        const int32_t t = leaves.ancestor[s];
        const int64_t apart = distanceSq(leaves.center[s], center[t], context.settings.dist);
        const int64_t own = leaves.radius[s].a; // a leaf's radius is a single root
        sums.local().add(
            std::size_t(t), {apart, own}, std::sqrt(double(apart)) + std::sqrt(double(own)));
    });
    nodes.radius.assign(nodes.balls.size(), 0.0);
    nodes.coverSq.assign(nodes.balls.size(), 0);
    for (const LargestSums& some : sums) some.addTo(nodes);
}

CoordBBox parentBox(const CoordBBox& box, const PyramidStep& step)
{
    return CoordBBox(step.parentVoxel(box.min()), step.parentVoxel(box.max()));
}

/// The boxes that bound a level.
struct Boxes {
    CoordBBox pyramid; ///< of the object's own OR pyramid
    CoordBBox clip;    ///< the same, unless a custom model has added voxels outside of it

    void coarsen(const PyramidStep& step)
    {
        pyramid = parentBox(pyramid, step);
        clip = parentBox(clip, step);
    }
};

/// Every voxel of the level whose centre lies within the radius of a node. The factor 1 + 1e-9 of
/// DESIGN 9 keeps voxels at the very distance in, whatever the rounding of R / f^k.
MaskTree::Ptr reconstruct(
    const LevelNodes& nodes, int level, CoordBBox box, const BuildContext& context)
{
    const double scale = double(context.frame(level).scale());
    const Distance& distance = context.settings.dist;
    std::vector<ExactSphere> spheres;
    for (std::size_t i = 0; i < nodes.balls.size(); ++i) {
        const double limit = nodes.radius[i] / scale * (1 + 1e-9);
        const auto whole = int64_t(limit);
        const Coord& c = nodes.balls[i].center;
        spheres.push_back({{2 * int64_t(c[0]), 2 * int64_t(c[1]), 2 * int64_t(c[2])},
            4 * (distance.isEuclidean() ? int64_t(limit * limit) : whole * whole)});
    }
    if (context.settings.reconstruct == Reconstruction::Free) {
        const CoordBBox free = boundingBox(spheres, distance);
        for (int axis = 0; axis < context.settings.dim; ++axis) {
            box.min()[axis] = free.min()[axis];
            box.max()[axis] = free.max()[axis];
        }
    }
    return sphereUnion(spheres, box, context.interrupter, distance);
}

/// Section 4.2 switched off: the stored sphere is the reconstruction's, grown like any ball's.
void useReconstructionRadii(
    LevelNodes& nodes, const Leaves& leaves, const LevelFrame& frame, const Distance& distance)
{
    const RootSum growth = frame.growth();
    for (double& radius : nodes.radius) radius = addUp(radius, growth.radius());
    for (std::size_t s = 0; s < leaves.center.size(); ++s) {
        const int32_t t = leaves.ancestor[s];
        const int64_t apart =
            distanceSq(leaves.center[s], frame.center(nodes.balls[t].center), distance);
        nodes.coverSq[t] =
            std::max(nodes.coverSq[t], coverSqOfRoots(apart, leaves.radius[s].a, growth.b));
    }
}

/// The voxels of the next level, whose medial balls are candidates for its nodes. @a boxes becomes
/// that level's.
MaskTree::Ptr nextVoxels(
    const MaskTree& voxels, int level, const BuildContext& context, Boxes& boxes)
{
    boxes.coarsen(context.stepFrom(level));
    const bool last = boxes.pyramid.volume() == 1;
    if (context.settings.reconstruct == Reconstruction::Free && last) {
        auto single = std::make_shared<MaskTree>(false);
        single->setValueOn(boxes.pyramid.min());
        return single;
    }
    MaskTree::Ptr next = context.coarsened(voxels, level);
    if (context.model) { // kept centres have to be inside, or their parent voxels might be off
        CoordBBox box;
        next->evalActiveVoxelBoundingBox(box);
        boxes.clip.expand(box);
    }
    return next;
}

} // namespace

std::vector<LevelNodes> extendedLevels(MaskTree::Ptr voxels, const BuildContext& context)
{
    const SphereTreeSettings& settings = context.settings;
    auto fine = context.medialLevel(*voxels, 0);
    Leaves leaves;
    Boxes boxes{context.bbox, context.bbox};
    std::vector<LevelNodes> levels{leafNodes(*fine, context.frame(0), leaves)};
    levels.back().topology = topologyOf(*fine, context);

    for (int level = 1; levels.back().balls.size() > 1; ++level) {
        voxels = timed("pyramid", context.interrupter, &context.seconds->pyramid,
            [&] { return nextVoxels(*voxels, level - 1, context, boxes); });
        auto coarse = context.medialLevel(*voxels, level, &levels.back());
        timed("parents and radii", context.interrupter, &context.seconds->tree, [&] {
            Links links = linkLevels(levels.back(), level - 1, *fine, *coarse, context);
            LevelNodes nodes = keepParents(links, *coarse);
            for (int32_t& node : leaves.ancestor) node = links.parent[node];
            fitRadii(nodes, leaves, context.frame(level), context);
            if (settings.reconstruct != Reconstruction::None && nodes.balls.size() > 1) {
                voxels = reconstruct(nodes, level, boxes.clip, context);
            }
            if (!settings.finalFit) {
                useReconstructionRadii(nodes, leaves, context.frame(level), settings.dist);
            }
            levels.back().parent = std::move(links.parent);
            levels.back().dag = std::move(links.dag);
            levels.push_back(std::move(nodes));
        });
        levels.back().topology = topologyOf(*coarse, context);
        fine = std::move(coarse);
    }
    return levels;
}

} // namespace detail
} // namespace openvdb_spheretree
