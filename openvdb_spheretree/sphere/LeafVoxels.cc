// SPDX-License-Identifier: Apache-2.0
#include "LeafVoxels.h"

#include "ClippedSphere.h"
#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/kernel/LeafBall.h>

#include <algorithm>
#include <cassert>

namespace openvdb_spheretree::detail {

namespace {

/// How far the farthest of a leaf's voxels is along an axis, in units.
/// @param center  from the leaf's corner
int64_t farthestAlong(int64_t center, int64_t last) { return std::max(center, last - center); }

/// ORs the voxels of a sphere into a leaf's by a kernel, where that is exact.
/// @param center    from the leaf's corner
/// @param farthest  what farthestAlong() is at most
/// @return whether it is
bool addByKernel(const int64_t center[3], int64_t farthest, int64_t radiusSq, int shift,
    const Distance& distance, LeafMask& mask)
{
    const int64_t reach = distance.isEuclidean() ? kLeafBallReach : kLeafNormReach;
    if (farthest > reach || radiusSq > reach * reach) return false;
    if (distance.isEuclidean()) {
        orBallIntoLeaf(center, radiusSq, shift, mask.data());
    } else {
        orNormBallIntoLeaf(center, distance, floorSqrt(radiusSq), shift, mask.data());
    }
    return true;
}

void addByRows(const ClippedSphere& sphere, const openvdb::Coord& origin, LeafMask& mask)
{
    forEachRow(sphere, origin, kLeafDim, [&](int32_t x, int32_t y, int32_t lo, int32_t hi) {
        if (lo <= hi) mask[x] |= rowBits(lo, hi) << (8 * y);
    });
}

/// @return the voxels of the leaf at @a origin that lie in the sphere's box.
LeafMask boxVoxels(const ClippedSphere& sphere, const openvdb::Coord& origin)
{
    constexpr int32_t kLast = kLeafDim - 1;
    int32_t first[3], last[3];
    for (int a = 0; a < 3; ++a) {
        first[a] = std::max(sphere.lo[a], origin[a]) - origin[a];
        last[a] = std::min(sphere.hi[a], origin[a] + kLast) - origin[a];
        assert(first[a] <= last[a]);
    }
    const uint64_t rows = ~uint64_t(0) >> (8 * (kLast - last[1])) & ~uint64_t(0) << (8 * first[1]);
    LeafMask box{};
    for (int32_t x = first[0]; x <= last[0]; ++x) {
        box[x] = rows & rowBits(first[2], last[2]) * 0x0101010101010101;
    }
    return box;
}

} // namespace

LeafMask voxelsOf(
    const ExactSphere& sphere, int shift, const openvdb::Coord& origin, const Distance& distance)
{
    const int64_t last = inUnits(kLeafDim - 1, shift);
    int64_t center[3], near[3], far[3];
    for (int a = 0; a < 3; ++a) {
        center[a] = sphere.center[a] - inUnits(origin[a], shift);
        near[a] = std::max<int64_t>(0, std::max(-center[a], center[a] - last));
        far[a] = farthestAlong(center[a], last);
    }
    const int64_t radiusSq = std::min(sphere.radiusSq, ClippedSphere::kMaxRadiusSq);
    if (distance.lengthSq(near[0], near[1], near[2]) > radiusSq) return LeafMask{};
    if (distance.lengthSq(far[0], far[1], far[2]) <= radiusSq) return LeafMask::full();
    LeafMask mask{};
    const int64_t farthest = std::max(far[0], std::max(far[1], far[2]));
    if (addByKernel(center, farthest, radiusSq, shift, distance, mask)) return mask;
    ClippedSphere inLeaf;
    const auto leaf = openvdb::CoordBBox::createCube(origin, kLeafDim);
    if (clipSphere(sphere, distance, shift, leaf, inLeaf)) addByRows(inLeaf, origin, mask);
    return mask;
}

void addVoxelsOf(const ClippedSphere& sphere, const openvdb::Coord& origin, LeafMask& mask)
{
    const int64_t last = inUnits(kLeafDim - 1, sphere.shift);
    int64_t center[3], farthest = 0;
    for (int a = 0; a < 3; ++a) {
        center[a] = sphere.center[a] - inUnits(origin[a], sphere.shift);
        farthest = std::max(farthest, farthestAlong(center[a], last));
    }
    LeafMask unclipped{};
    LeafMask& target = sphere.clipped ? unclipped : mask;
    if (!addByKernel(center, farthest, sphere.radiusSq, sphere.shift, sphere.distance, target)) {
        addByRows(sphere, origin, mask);
    } else if (sphere.clipped) {
        mask |= unclipped & boxVoxels(sphere, origin);
    }
}

} // namespace openvdb_spheretree::detail
