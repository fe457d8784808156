// SPDX-License-Identifier: Apache-2.0
#include "LeafBalls.h"

#include "BallPruning.h"
#include "VoxelRegion.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/sphere/SphereUnion.h>
#include <openvdb_spheretree/tree/GivenTree.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>

#include <openvdb/Exceptions.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

constexpr double kMaxRadius = 32767; // voxels, as of medial balls

/// @param center  in voxels, turned as the object is
/// @param radius  in voxels
ExactSphere ballAroundGiven(const openvdb::Vec3d& center, double radius)
{
    ExactSphere ball;
    double movedSq = 0; // in units of 1/16 voxel, as all below
    for (int axis = 0; axis < 3; ++axis) {
        const double there = double(kFine) * center[axis];
        ball.center[axis] = int64_t(std::floor(there + 0.5));
        const double moved = there - double(ball.center[axis]);
        movedSq += moved * moved;
    }
    constexpr double kRounding = 1 + 1e-12; // more than that of the terms here
    const double reach = (double(kFine) * radius + std::sqrt(movedSq)) * kRounding;
    ball.radiusSq = int64_t(std::ceil(reach * reach * kRounding));
    return ball;
}

void requireCovering(const std::vector<ExactSphere>& balls, const FlatAxis& flat,
    const openvdb::MaskTree& voxels, openvdb::util::NullInterrupter* interrupter)
{
    openvdb::CoordBBox box;
    voxels.evalActiveVoxelBoundingBox(box);
    const auto covered = sphereUnion(balls, box, {Distance(), int(kFine)}, interrupter);
    const auto bare = detail::maskDifference(voxels, *covered, interrupter);
    if (bare.voxels == 0) return;
    OPENVDB_THROW(openvdb::ValueError,
        "leaves=given: "
            << bare.voxels << (bare.voxels == 1 ? " voxel" : " voxels")
            << " of the object, such as " << flat.fromZ(bare.cubes.front().first())
            << ", are in none of the spheres, and a tree has to cover all: make the "
               "spheres larger, or take another object (that of the spheres themselves "
               "is -spheres2mask)");
}

} // namespace

LeafBalls medialLeaves(const MedialLevel& level, const SampleLevel& object, Leaves which,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<ExactSphere> balls;
    for (const MedialBall& ball : level.balls) balls.push_back(fineBall(ball));
    if (which == Leaves::Medial) return {std::move(balls), level.balls};
    LeafBalls leaves;
    for (const int32_t i : prunedBalls(std::move(balls), object, interrupter)) {
        leaves.balls.push_back(fineBall(level.balls[i]));
        leaves.digital.push_back(level.balls[i]);
    }
    return leaves;
}

LeafBalls givenLeaves(const SphereTree& given, const FlatAxis& flat,
    const openvdb::MaskTree& voxels, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<ExactSphere> balls;
    for (int32_t id = 0; id < given.size(); ++id) {
        if (!(given.spheres.radius[id] <= kMaxRadius)) {
            OPENVDB_THROW(openvdb::ValueError,
                "leaves=given: sphere " << id << " has a radius of " << given.spheres.radius[id]
                                        << " voxels, and the most is " << kMaxRadius);
        }
        // Around the sphere as it was before its center was rounded to the tree's units.
        balls.push_back(ballAroundGiven(
            flat.toZ(given.spheres.center[id]), given.spheres.radius[id] + kGivenMove));
    }
    requireCovering(balls, flat, voxels, interrupter);
    std::vector<char> holdsAny(balls.size());
    detail::parallelFor(balls.size(), interrupter,
        [&](std::size_t i) { holdsAny[i] = !regionOf(balls[i], object).empty(); });
    LeafBalls leaves;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (holdsAny[i]) leaves.balls.push_back(balls[i]);
    }
    return leaves;
}

} // namespace openvdb_spheretree::tight
