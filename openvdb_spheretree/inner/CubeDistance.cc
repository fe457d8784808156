// SPDX-License-Identifier: Apache-2.0
#include "CubeDistance.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/tools/Morphology.h>

#include <algorithm>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskTree;

/// @return the voxels outside that share a face with one of the object, in its plane if it is flat.
MaskTree::Ptr shellOf(const MaskTree& object, const CoordBBox& box, int flatAxis)
{
    using namespace openvdb::tools;
    auto shell = std::make_shared<MaskTree>(object);
    dilateActiveValues(*shell, 1, NN_FACE, PRESERVE_TILES);
    shell->topologyDifference(object);
    if (flatAxis < 0) return shell;
    CoordBBox plane = box;
    plane.expand(1);
    plane.min()[flatAxis] = plane.max()[flatAxis] = box.min()[flatAxis];
    shell->clip(plane);
    return shell;
}

} // namespace

CubeDistance::CubeDistance(
    const MaskTree& object, int flatAxis, openvdb::util::NullInterrupter* interrupter)
{
    CoordBBox box;
    object.evalActiveVoxelBoundingBox(box);
    mOrigin = box.min();
    const MaskTree::Ptr shell = shellOf(object, box, flatAxis);
    CoordBBox around(Coord(-1), Coord(1));
    if (flatAxis >= 0) around.min()[flatAxis] = around.max()[flatAxis] = 0;

    MaskTree cubes(false); // in half voxels
    openvdb::tree::ValueAccessor<MaskTree> accessor(cubes);
    for (auto leaf = shell->cbeginLeaf(); leaf; ++leaf) {
        checkInterrupt(interrupter);
        for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel) {
            const Coord from = voxel.getCoord() - mOrigin;
            const Coord center(2 * from[0], 2 * from[1], 2 * from[2]);
            for (auto step = around.begin(); step; ++step) accessor.setValueOn(center + *step);
        }
    }
    mOutside = std::make_unique<NearestVoxel>(cubes);
}

int64_t CubeDistance::halvesSq(const Coord& voxel) const
{
    int64_t point2[3]; // twice the point in half voxels, as the query wants it
    for (int axis = 0; axis < 3; ++axis) point2[axis] = 4 * (int64_t(voxel[axis]) - mOrigin[axis]);
    return mOutside->distSq(point2, 0) / 4;
}

std::vector<MedialBall> withinCubes(const std::vector<MedialBall>& balls,
    const CubeDistance& distance, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<MedialBall> result(balls);
    parallelFor(balls.size(), interrupter, [&](std::size_t i) {
        const int64_t closedSq =
            distance.halvesSq(balls[i].center) / 4; // whole voxels, rounded down
        result[i].radiusSq = std::min(result[i].radiusSq, int32_t(closedSq) + 1);
    });
    return result;
}

} // namespace openvdb_spheretree::detail
