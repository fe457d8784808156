// SPDX-License-Identifier: Apache-2.0
#include "LeafVoxels.h"

#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/kernel/LeafBall.h>

#include <algorithm>

namespace openvdb_spheretree {
namespace detail {

namespace {

/// The voxels i in 0...7 of a row with |2^shift i - center| <= half, as a byte.
uint64_t rowByte(int64_t center, int64_t half, int shift)
{
    const int64_t first = std::max<int64_t>(0, (center - half + (1 << shift) - 1) >> shift);
    const int64_t last = std::min<int64_t>(7, (center + half) >> shift);
    if (first > last) return 0;
    return (uint64_t(0xff) << first) & (uint64_t(0xff) >> (7 - last));
}

} // namespace

LeafMask voxelsOf(const ExactSphere& sphere, int shift, const openvdb::Coord& origin)
{
    LeafMask mask{};
    int64_t center[3], nearestSq = 0, farthestSq = 0, farthest = 0; // of the leaf's voxels
    const int64_t last = int64_t(kLeafDim - 1) << shift;
    for (int a = 0; a < 3; ++a) {
        center[a] = sphere.center[a] - int64_t(origin[a]) * (int64_t(1) << shift);
        const int64_t near = std::max<int64_t>(0, std::max(-center[a], center[a] - last));
        const int64_t far = std::max(center[a], last - center[a]);
        nearestSq += near * near;
        farthestSq += far * far;
        farthest = std::max(farthest, far);
    }
    if (nearestSq > sphere.radiusSq) return mask;
    if (farthestSq <= sphere.radiusSq) {
        mask.fill(~uint64_t(0));
        return mask;
    }
    if (farthest <= kLeafBallReach && sphere.radiusSq <= kLeafBallReach * kLeafBallReach) {
        orBallIntoLeaf(center, sphere.radiusSq, shift, mask.data());
        return mask;
    }
    for (int x = 0; x < kLeafDim; ++x) {
        const int64_t dx = (int64_t(x) << shift) - center[0], slice = sphere.radiusSq - dx * dx;
        for (int y = 0; y < kLeafDim; ++y) {
            const int64_t dy = (int64_t(y) << shift) - center[1], row = slice - dy * dy;
            if (row >= 0) mask[x] |= rowByte(center[2], floorSqrt(row), shift) << (8 * y);
        }
    }
    return mask;
}

} // namespace detail
} // namespace openvdb_spheretree
