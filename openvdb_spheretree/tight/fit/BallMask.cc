// SPDX-License-Identifier: Apache-2.0
#include "BallMask.h"

#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/sphere/LeafVoxels.h>

#include <algorithm>
#include <limits>

namespace openvdb_spheretree {
namespace tight {

namespace {

openvdb::CoordBBox leafBox(const openvdb::Coord& origin)
{
    return openvdb::CoordBBox::createCube(origin, kLeafDim);
}

} // namespace

BoxReach::BoxReach(const FineBall& ball, const openvdb::CoordBBox& box)
{
    for (int a = 0; a < 3; ++a) {
        const int64_t first = kFine * int64_t(box.min()[a]), last = kFine * int64_t(box.max()[a]);
        const int64_t c = ball.center[a];
        const int64_t near = std::max(first, std::min(c, last)) - c;
        const int64_t far = std::max(c - first, last - c);
        nearestSq += near * near;
        farthestSq += far * far;
    }
}

LeafMask ballMask(const FineBall& ball, const openvdb::Coord& origin)
{
    const ExactSphere sphere{{ball.center[0], ball.center[1], ball.center[2]}, ball.radiusSq};
    return detail::voxelsOf(sphere, /*shift=*/4, origin);
}

bool mayReach(const FineBall& ball, const openvdb::Coord& origin)
{
    return BoxReach(ball, leafBox(origin)).meets(ball);
}

bool ballBox(const FineBall& ball, openvdb::CoordBBox& box)
{
    if (ball.empty()) return false;
    const int64_t reach = detail::floorSqrt(ball.radiusSq);
    for (int a = 0; a < 3; ++a) {
        const int64_t lo = (ball.center[a] - reach + 15) >> 4, hi = (ball.center[a] + reach) >> 4;
        constexpr int64_t kLeast = std::numeric_limits<int32_t>::min() + 8;
        constexpr int64_t kMost = std::numeric_limits<int32_t>::max() - 8;
        box.min()[a] = int32_t(std::max(kLeast, std::min(kMost, lo)));
        box.max()[a] = int32_t(std::max(kLeast, std::min(kMost, hi)));
        if (lo > hi) return false;
    }
    return true;
}

} // namespace tight
} // namespace openvdb_spheretree
