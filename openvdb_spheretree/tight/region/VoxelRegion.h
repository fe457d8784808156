// SPDX-License-Identifier: Apache-2.0
/// @file VoxelRegion.h
/// @brief A sparse set of object voxels.

#pragma once

#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// The voxels of a region in one leaf of the object.
struct RegionLeaf {
    uint32_t leaf;
    LeafMask mask;
};
/// In the order of leaves; no part is empty.
using VoxelRegion = std::vector<RegionLeaf>;

/// @return the object voxels in @a ball.
VoxelRegion regionOf(const ExactSphere& ball, const SampleLevel& object);

/// @return the object voxels in each ball.
std::vector<VoxelRegion> regionsOf(const std::vector<ExactSphere>& balls, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter);

/// @return the voxels of the region in one leaf.
const LeafMask& maskIn(const VoxelRegion& region, uint32_t leaf);

/// Calls body(leaf, maskOfA, maskOfB) for the leaves of either region, in order.
template <typename Body>
void forEachLeafOfBoth(const VoxelRegion& a, const VoxelRegion& b, const Body& body)
{
    constexpr LeafMask kNone{};
    std::size_t i = 0, j = 0;
    while (i < a.size() || j < b.size()) {
        const bool fromA = i < a.size() && (j == b.size() || a[i].leaf <= b[j].leaf);
        const bool fromB = j < b.size() && (i == a.size() || b[j].leaf <= a[i].leaf);
        body(fromA ? a[i].leaf : b[j].leaf, fromA ? a[i].mask : kNone, fromB ? b[j].mask : kNone);
        i += fromA;
        j += fromB;
    }
}

/// @return the voxels of a region that lie in @a ball.
VoxelRegion clipped(const VoxelRegion& region, const ExactSphere& ball, const SampleLevel& object);

VoxelRegion unionOf(const VoxelRegion& a, const VoxelRegion& b);
VoxelRegion unionOf(const std::vector<const VoxelRegion*>& regions);
VoxelRegion intersectionOf(const VoxelRegion& a, const VoxelRegion& b);
/// @return the voxels of @a a that are not in @a b.
VoxelRegion differenceOf(const VoxelRegion& a, const VoxelRegion& b);

} // namespace openvdb_spheretree::tight
