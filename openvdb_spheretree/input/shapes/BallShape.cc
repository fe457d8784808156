// SPDX-License-Identifier: Apache-2.0
#include "BallShape.h"

#include <openvdb_spheretree/base/IntegerRoot.h>

#include <algorithm>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

/// The largest radiusSq with (4 pi / 3)^2 radiusSq^3 <= voxels^2. It needs only products, which
/// every machine rounds alike; cube roots are not.
int64_t radiusSqOf(int64_t voxels)
{
    constexpr double kVolumeSq = 17.545963379714415; // of the unit ball, squared
    const double volumeSq = double(voxels) * double(voxels);
    int64_t low = 0, high = int64_t(1) << 42; // radii of 2^21 are more than 2^63 voxels
    while (high - low > 1) {
        const int64_t middle = low + (high - low) / 2;
        const double r = double(middle);
        (kVolumeSq * r * r * r <= volumeSq ? low : high) = middle;
    }
    return low;
}

} // namespace

SolidBall::SolidBall(int64_t voxels) : mRadiusSq(radiusSqOf(voxels)) {}

CoordBBox SolidBall::box() const
{
    const int reach = int(floorSqrt(mRadiusSq));
    return {Coord(-reach), Coord(reach)};
}

Filling SolidBall::filling(const CoordBBox& cube) const
{
    int64_t nearestSq = 0, farthestSq = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int64_t lo = cube.min()[axis], hi = cube.max()[axis];
        farthestSq += std::max(square(lo), square(hi));
        if (lo > 0 || hi < 0) nearestSq += std::min(square(lo), square(hi));
    }
    if (farthestSq < mRadiusSq) return Filling::All;
    return nearestSq < mRadiusSq ? Filling::Part : Filling::None;
}

LeafMask SolidBall::leaf(const Coord& origin) const
{
    LeafMask mask{};
    for (uint32_t n = 0; n < kLeafVoxels; ++n) {
        const Coord q = leafVoxel(origin, n);
        if (square(q[0]) + square(q[1]) + square(q[2]) < mRadiusSq) mask.setOn(n);
    }
    return mask;
}

} // namespace openvdb_spheretree::detail
