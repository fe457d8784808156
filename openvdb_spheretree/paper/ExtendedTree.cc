// SPDX-License-Identifier: Apache-2.0
/// @file ExtendedTree.cc
/// @brief The extended tree (Broutta et al. 2009, Algorithm 2 and Section 4.2): every sphere
/// contains the leaf balls below it.
///
/// Level 0 is the medial balls of the object. Then, from each level to the one above:
/// 1. `nextVoxels`: coarsen the level's voxels by the pyramid model; take their medial balls and
///    labels; every node's parent is the label of the parent voxel of its center (`linkLevels`);
/// 2. `keepParents`: a ball without children is dropped;
/// 3. `fitRadii`: a kept ball's radius R is the largest |C_s - C_t| + R_s over the leaf balls s
///    below it; it may be smaller than the medial ball it came from;
/// 4. `reconstruct`: the level's voxels become those within R of a kept center. They are clipped to
///    the box of the object's own pyramid level: the paper's images have borders, and without the
///    clip levels swell from step to step (Al.100: 630 % error with 9 spheres, against 419 % with
///    12).
///
/// It ends: the clip box of the pyramid's last level is one voxel. Without the clip (`free`), all
/// nodes left at that level get one parent there. Closings stay in the box; where a custom model
/// leaves it, the box grows to what the model made, so that kept centers stay on, and a model that
/// never lets the levels shrink to one ball is an error. Radii come from leaf balls and centers
/// alone, so every level covers the object whatever the model. Radii are integers under square
/// roots (LevelFrame.h). Cost: linear in the voxels of all levels, and about so in the nodes for
/// the radii (FarthestLeaves.h). Tests: TestExtendedTree.cc; golden counts and errors in
/// tests/golden.

#include "FarthestLeaves.h"
#include "TreeLevels.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Rounding.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/sphere/SphereUnion.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::CoordBBox;
using openvdb::MaskTree;

/// @return the balls of @a coarse that have children; @a links become links to these.
LevelNodes keepParents(
    Links& links, const MedialLevel& coarse, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<std::atomic<bool>> isParent(coarse.balls.size());
    parallelFor(links.parent.size(), interrupter, [&](std::size_t i) {
        isParent[std::size_t(links.parent[i])].store(true, std::memory_order_relaxed);
    });
    std::vector<int32_t> nodeOfBall(coarse.balls.size(), -1);
    LevelNodes kept;
    kept.pyramidVoxels = coarse.layout.voxelCount();
    kept.balls.reserve(std::size_t(std::count(isParent.begin(), isParent.end(), true)));
    for (std::size_t ball = 0; ball < nodeOfBall.size(); ++ball) {
        if (!isParent[ball]) continue;
        nodeOfBall[ball] = int32_t(kept.balls.size());
        kept.balls.push_back(coarse.balls[ball]);
    }
    parallelFor(links.parent.size(), interrupter,
        [&](std::size_t i) { links.parent[i] = nodeOfBall[std::size_t(links.parent[i])]; });
    std::vector<DagEdge> dag;
    for (const DagEdge& edge : links.dag) {
        const int32_t parent = nodeOfBall[edge.parent];
        if (parent >= 0) dag.push_back({parent, edge.child});
    }
    links.dag = std::move(dag);
    return kept;
}

/// The smallest radii, around the nodes' own centers, that contain the leaf balls below them. Roots
/// of doubles tell nearly always which of two leaf balls reaches farther: exact arithmetic is for
/// those that may be the farthest.
/// @param levels  those below, and the nodes' own at the end
void fitRadii(std::vector<LevelNodes>& levels, const std::vector<CompressedRows>& below,
    const BuildContext& context)
{
    constexpr double kDoubt = 1e-12; // of a sum of roots, whose error is 1e-15
    const int level = int(levels.size()) - 1;
    LevelNodes& nodes = levels.back();
    std::vector<LevelFrame> frames;
    for (int k = 0; k <= level; ++k) frames.push_back(context.frame(k));
    const auto centerOf = [&](int k, int32_t node) {
        return frames[k].center(levels[k].balls[node].center);
    };
    const Distance& distance = context.settings.dist();
    const auto widthOf = [&](const MedialBall& leaf) { // twice the radius, nearly
        return distance.isEuclidean() ? 2 * std::sqrt(double(leaf.radiusSq - 1))
                                      : std::sqrt(double(frames[0].radius(leaf.radiusSq).a));
    };
    resizeLarge(nodes.radius, nodes.balls.size());
    resizeLarge(nodes.coverSq, nodes.balls.size());
    const auto fit = [&](std::size_t t, FarthestLeaves& leaves) {
        const Doubled center = centerOf(level, int32_t(t));
        const auto reach = [&](int k, int32_t node) {
            const Doubled c = centerOf(k, node);
            const double apart = distance.length(
                double(c.x - center.x), double(c.y - center.y), double(c.z - center.z));
            const double width =
                k == 0 ? widthOf(levels[0].balls[node]) : 2 * levels[k].radius[node];
            return (apart + width) * (1 + kDoubt);
        };
        double most = 0; // twice the radius: a smaller double is of a smaller sum
        leaves.search(level, int32_t(t), reach, [&](int32_t leaf) {
            const int64_t apart = distanceSq(centerOf(0, leaf), center, distance);
            const RootSum sum{apart, frames[0].radius(levels[0].balls[leaf].radiusSq).a}; // no b
            most = std::max(
                most, (std::sqrt(double(sum.a)) + std::sqrt(double(sum.b))) * (1 - kDoubt));
            nodes.radius[t] = std::max(nodes.radius[t], sum.radius());
            nodes.coverSq[t] = std::max(nodes.coverSq[t], sum.coverSq());
            return most;
        });
    };
    parallelForWith(
        nodes.balls.size(), context.interrupter, [&] { return FarthestLeaves(below); }, fit);
}

/// The boxes that bound a level.
struct Boxes {
    CoordBBox pyramid; ///< of the object's own OR pyramid
    CoordBBox clip;    ///< the same, unless a custom model has added voxels outside of it
};

/// Every voxel of the level whose center lies within the radius of a node. The factor 1 + 1e-9
/// keeps voxels at the very distance in: it is far above the rounding of R / f^k, 1e-15 of it.
MaskTree::Ptr reconstruct(
    const LevelNodes& nodes, int level, CoordBBox box, const BuildContext& context)
{
    const double scale = double(context.frame(level).scale());
    const Distance& distance = context.settings.dist();
    std::vector<ExactSphere> spheres;
    resizeLarge(spheres, nodes.balls.size());
    parallelFor(spheres.size(), context.interrupter, [&](std::size_t i) {
        const double limit = nodes.radius[i] / scale * (1 + 1e-9);
        const auto whole = int64_t(limit);
        spheres[i] = ExactSphere::around(nodes.balls[i].center,
            4 * (distance.isEuclidean() ? int64_t(limit * limit) : whole * whole));
    });
    if (context.settings.extended().reconstruct == Reconstruction::Free) {
        const CoordBBox free = boundingBox(spheres, distance);
        for (int axis = 0; axis < context.settings.dim; ++axis) {
            box.min()[axis] = free.min()[axis];
            box.max()[axis] = free.max()[axis];
        }
    }
    return sphereUnion(spheres, box, distance, context.interrupter);
}

/// Section 4.2 switched off: the stored sphere is the reconstruction's, grown like any ball's.
void useReconstructionRadii(std::vector<LevelNodes>& levels, const BuildContext& context)
{
    const LevelFrame frame = context.frame(int(levels.size()) - 1), leafFrame = context.frame(0);
    const RootSum growth = frame.growth();
    LevelNodes& nodes = levels.back();
    for (double& radius : nodes.radius) radius = addUp(radius, growth.radius());
    const std::vector<MedialBall>& leaves = levels.front().balls;
    for (std::size_t s = 0; s < leaves.size(); ++s) {
        int32_t t = int32_t(s);
        for (std::size_t k = 0; k + 1 < levels.size(); ++k) t = levels[k].parent[t];
        const int64_t apart = distanceSq(leafFrame.center(leaves[s].center),
            frame.center(nodes.balls[t].center), context.settings.dist());
        nodes.coverSq[t] = std::max(nodes.coverSq[t],
            coverSqOfRoots(apart, leafFrame.radius(leaves[s].radiusSq).a, growth.b));
    }
}

/// The voxels of the next level, whose medial balls are candidates for its nodes. @a boxes becomes
/// that level's.
MaskTree::Ptr nextVoxels(
    const MaskTree& voxels, int level, const BuildContext& context, Boxes& boxes)
{
    const PyramidStep step = context.stepFrom(level);
    for (CoordBBox* box : {&boxes.pyramid, &boxes.clip}) {
        *box = CoordBBox(step.parentVoxel(box->min()), step.parentVoxel(box->max()));
    }
    const bool last = boxes.pyramid.volume() == 1;
    if (context.settings.extended().reconstruct == Reconstruction::Free && last) {
        auto single = std::make_shared<MaskTree>(false);
        single->setValueOn(boxes.pyramid.min());
        return single;
    }
    MaskTree::Ptr next = context.coarsened(voxels, level);
    if (context.model) { // kept centers have to be inside, or their parent voxels might be off
        CoordBBox box;
        next->evalActiveVoxelBoundingBox(box);
        boxes.clip.expand(box);
    }
    return next;
}

} // namespace

std::vector<LevelNodes> extendedLevels(MaskTree::Ptr voxels, const BuildContext& context)
{
    const ExtendedOptions& options = context.settings.extended();
    auto fine = context.medialLevel(*voxels, 0);
    Boxes boxes{context.bbox, context.bbox};
    std::vector<LevelNodes> levels;
    levels.push_back(context.allBalls(fine));
    std::vector<CompressedRows> below;

    for (int level = 1; levels.back().balls.size() > 1; ++level) {
        voxels = timed("pyramid", context.interrupter, &context.seconds->pyramid,
            [&] { return nextVoxels(*voxels, level - 1, context, boxes); });
        auto coarse = context.medialLevel(*voxels, level, &levels.back());
        timed("parents and radii", context.interrupter, &context.seconds->tree, [&] {
            Links links = linkLevels(levels.back(), level - 1, fine.get(), *coarse, context);
            LevelNodes nodes = keepParents(links, *coarse, context.interrupter);
            below.push_back(compressedRows(links.parent, nodes.balls.size()));
            levels.back().parent = std::move(links.parent);
            levels.back().dag = std::move(links.dag);
            levels.push_back(std::move(nodes));
            fitRadii(levels, below, context);
            if (options.reconstruct != Reconstruction::None && levels.back().balls.size() > 1) {
                voxels = reconstruct(levels.back(), level, boxes.clip, context);
            }
            if (!options.finalFit) useReconstructionRadii(levels, context);
        });
        levels.back().topology = topologyOf(*coarse, context);
        if (needsDag(options)) fine = std::move(coarse);
    }
    return levels;
}

} // namespace openvdb_spheretree::detail
