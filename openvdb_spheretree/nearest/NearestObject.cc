// SPDX-License-Identifier: Apache-2.0
#include "NearestObject.h"

#include <openvdb_spheretree/inner/InnerOrder.h>
#include <openvdb_spheretree/measure/FarthestVoxel.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/sphere/SphereUnion.h>
#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/Masks.h>

namespace openvdb_spheretree::nearest {

namespace {

openvdb::MaskTree::Ptr unionOf(const NearestObject& object, const std::vector<ExactSphere>& spheres)
{
    const SphereMetric metric{Distance(), int(tight::kFine)};
    openvdb::CoordBBox box = boundingBox(spheres, metric);
    if (object.dim == 2) box.min()[2] = box.max()[2] = 0;
    return sphereUnion(spheres, box, metric, object.interrupter);
}

} // namespace

int64_t wrongVoxels(const NearestObject& object, const std::vector<ExactSphere>& spheres)
{
    const auto covered = unionOf(object, spheres);
    const detail::MaskMinus outside(*covered, object.voxels);
    const int64_t excess = detail::countVoxels(outside, object.interrupter).voxels;
    const int64_t held = detail::countVoxels(*covered) - excess;
    return excess + (object.voxelCount - held);
}

std::vector<ExactSphere> missingBalls(
    const NearestObject& object, const std::vector<ExactSphere>& spheres, int64_t most)
{
    openvdb::MaskTree missing(object.voxels);
    missing.topologyDifference(*unionOf(object, spheres));
    missing.prune();
    std::vector<ExactSphere> balls;
    if (detail::countVoxels(missing) == 0) return balls;
    LevelQueries queries;
    queries.memory = object.memory;
    const MedialLevel medial(
        missing, object.dim, Distance(), object.interrupter, /*seconds=*/nullptr, queries);
    const detail::InnerOrder order =
        detail::innerOrder(medial.layout, medial.balls, object.dim, most, object.interrupter);
    for (const int32_t ball : order.ball) balls.push_back(tight::fineBall(medial.balls[ball]));
    return balls;
}

} // namespace openvdb_spheretree::nearest
