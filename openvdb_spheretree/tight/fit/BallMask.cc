// SPDX-License-Identifier: Apache-2.0
#include "BallMask.h"

#include <openvdb_spheretree/base/RoundUp.h>
#include <openvdb_spheretree/kernel/LeafBall.h>

#include <algorithm>
#include <limits>

namespace openvdb_spheretree {
namespace tight {

namespace {

openvdb::CoordBBox leafBox(const openvdb::Coord& origin)
{
    return openvdb::CoordBBox::createCube(origin, kLeafDim);
}

/// The voxels i in 0...7 of a row with |16 i - center| <= half, as a byte.
uint64_t rowByte(int64_t center, int64_t half)
{
    const int64_t first = std::max<int64_t>(0, (center - half + 15) >> 4);
    const int64_t last = std::min<int64_t>(7, (center + half) >> 4);
    if (first > last) return 0;
    return (uint64_t(0xff) << first) & (uint64_t(0xff) >> (7 - last));
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
    LeafMask mask{};
    const BoxReach reach(ball, leafBox(origin));
    if (!reach.meets(ball)) return mask;
    if (reach.isHeldBy(ball)) {
        mask.fill(~uint64_t(0));
        return mask;
    }
    int64_t center[3];
    int64_t farthest = 0; // of the leaf's voxels, along any axis
    for (int a = 0; a < 3; ++a) {
        center[a] = ball.center[a] - kFine * int64_t(origin[a]);
        farthest = std::max(farthest, std::max(center[a], 7 * kFine - center[a]));
    }
    using detail::kLeafBallReach;
    if (farthest <= kLeafBallReach && ball.radiusSq <= kLeafBallReach * kLeafBallReach) {
        detail::orBallIntoLeaf(center, ball.radiusSq, /*shift=*/4, mask.data());
        return mask;
    }
    for (int x = 0; x < 8; ++x) {
        const int64_t dx = kFine * x - center[0], slice = ball.radiusSq - dx * dx;
        for (int y = 0; y < 8; ++y) {
            const int64_t dy = kFine * y - center[1], row = slice - dy * dy;
            if (row >= 0) mask[x] |= rowByte(center[2], detail::floorSqrt(row)) << (8 * y);
        }
    }
    return mask;
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
