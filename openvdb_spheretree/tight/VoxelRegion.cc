// SPDX-License-Identifier: Apache-2.0
#include "VoxelRegion.h"

namespace openvdb_spheretree {
namespace tight {

namespace {

LeafMask intersection(const LeafMask& a, const LeafMask& b)
{
    LeafMask result;
    for (int word = 0; word < 8; ++word) result[word] = a[word] & b[word];
    return result;
}

void append(VoxelRegion& region, std::size_t leaf, const LeafMask& mask)
{
    if (!isEmpty(mask)) region.push_back({uint32_t(leaf), mask});
}

} // namespace

VoxelRegion regionOf(const FineBall& ball, const SampleLevel& object)
{
    VoxelRegion region;
    openvdb::CoordBBox box;
    if (!ballBox(ball, box)) return region;
    object.forEachLeaf(box, [&](std::size_t leaf) {
        append(region, leaf, intersection(ballMask(ball, object.origin(leaf)), object.mask(leaf)));
    });
    return region;
}

VoxelRegion clippedUnion(
    const VoxelRegion& a, const VoxelRegion& b, const FineBall& ball, const SampleLevel& object)
{
    VoxelRegion region;
    forEachLeafOfBoth(a, b, [&](uint32_t leaf, const LeafMask& inA, const LeafMask& inB) {
        LeafMask mask = ballMask(ball, object.origin(leaf));
        for (int word = 0; word < 8; ++word) mask[word] &= inA[word] | inB[word];
        append(region, leaf, mask);
    });
    return region;
}

} // namespace tight
} // namespace openvdb_spheretree
