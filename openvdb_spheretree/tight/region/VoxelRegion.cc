// SPDX-License-Identifier: Apache-2.0
#include "VoxelRegion.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/sphere/LeafVoxels.h>
#include <openvdb_spheretree/tight/fit/BallReach.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree::tight {

VoxelRegion regionOf(const ExactSphere& ball, const SampleLevel& object)
{
    VoxelRegion region;
    object.forEachLeaf(ballBox(ball), [&](std::size_t leaf) {
        const LeafMask mask =
            detail::voxelsOf(ball, kFineShift, object.origin(leaf)) & object.mask(leaf);
        if (!mask.none()) region.push_back({uint32_t(leaf), mask});
    });
    return region;
}

std::vector<VoxelRegion> regionsOf(const std::vector<ExactSphere>& balls, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<VoxelRegion> regions(balls.size());
    detail::parallelFor(
        balls.size(), interrupter, [&](std::size_t i) { regions[i] = regionOf(balls[i], object); });
    return regions;
}

const LeafMask& maskIn(const VoxelRegion& region, uint32_t leaf)
{
    static const LeafMask kNone{};
    const auto found = std::lower_bound(region.begin(), region.end(), leaf,
        [](const RegionLeaf& part, uint32_t index) { return part.leaf < index; });
    return found != region.end() && found->leaf == leaf ? found->mask : kNone;
}

VoxelRegion clipped(const VoxelRegion& region, const ExactSphere& ball, const SampleLevel& object)
{
    VoxelRegion inside;
    for (const RegionLeaf& part : region) {
        const openvdb::Coord& origin = object.origin(part.leaf);
        if (!mayReach(ball, origin)) continue;
        const LeafMask mask = detail::voxelsOf(ball, kFineShift, origin) & part.mask;
        if (!mask.none()) inside.push_back({part.leaf, mask});
    }
    return inside;
}

VoxelRegion unionOf(const VoxelRegion& a, const VoxelRegion& b)
{
    VoxelRegion region;
    forEachLeafOfBoth(a, b, [&](uint32_t leaf, const LeafMask& inA, const LeafMask& inB) {
        region.push_back({leaf, inA | inB});
    });
    return region;
}

VoxelRegion unionOf(const std::vector<const VoxelRegion*>& regions)
{
    // Pointers are sorted, as masks are large.
    thread_local std::vector<std::pair<uint32_t, const LeafMask*>> parts;
    parts.clear();
    for (const VoxelRegion* region : regions) {
        for (const RegionLeaf& part : *region) parts.emplace_back(part.leaf, &part.mask);
    }
    std::sort(
        parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::size_t leaves = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        leaves += i == 0 || parts[i].first != parts[i - 1].first;
    }
    VoxelRegion united;
    united.reserve(leaves);
    for (const auto& [leaf, mask] : parts) {
        if (!united.empty() && united.back().leaf == leaf) united.back().mask |= *mask;
        else united.push_back({leaf, *mask});
    }
    return united;
}

VoxelRegion intersectionOf(const VoxelRegion& a, const VoxelRegion& b)
{
    VoxelRegion region;
    auto other = b.begin(); // searched, as b may be much larger
    for (const RegionLeaf& part : a) {
        other = std::lower_bound(other, b.end(), part.leaf,
            [](const RegionLeaf& some, uint32_t leaf) { return some.leaf < leaf; });
        if (other == b.end()) break;
        const LeafMask both = other->leaf == part.leaf ? part.mask & other->mask : LeafMask{};
        if (!both.none()) region.push_back({part.leaf, both});
    }
    return region;
}

VoxelRegion differenceOf(const VoxelRegion& a, const VoxelRegion& b)
{
    VoxelRegion region;
    std::size_t j = 0;
    for (const RegionLeaf& part : a) {
        while (j < b.size() && b[j].leaf < part.leaf) ++j;
        const bool inBoth = j < b.size() && b[j].leaf == part.leaf;
        const LeafMask left = inBoth ? part.mask - b[j].mask : part.mask;
        if (!left.none()) region.push_back({part.leaf, left});
    }
    return region;
}

} // namespace openvdb_spheretree::tight
