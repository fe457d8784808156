// SPDX-License-Identifier: Apache-2.0
#include "VoxelRegion.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/sphere/LeafVoxels.h>
#include <openvdb_spheretree/tight/fit/BallReach.h>

#include <algorithm>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// Appends those voxels of @a mask, in a leaf of the object, that lie in @a ball.
void appendClipped(uint32_t leaf, const LeafMask& mask, const ExactSphere& ball,
    const openvdb::Coord& origin, VoxelRegion& region)
{
    const BoxReach reach(ball, openvdb::CoordBBox::createCube(origin, kLeafDim));
    if (!reach.meets(ball)) return;
    const bool isHeld = reach.isHeldBy(ball);
    region.append(leaf, isHeld ? mask : detail::voxelsOf(ball, kFineShift, origin) & mask);
}

/// @return an empty region, of the object of a region that is not.
VoxelRegion sameObject(const VoxelRegion& region)
{
    return region.empty() ? VoxelRegion() : VoxelRegion(region.object());
}

} // namespace

VoxelRegion regionOf(const ExactSphere& ball, const SampleLevel& object)
{
    VoxelRegion region(object);
    object.forEachLeaf(ballBox(ball), [&](std::size_t leaf) {
        appendClipped(uint32_t(leaf), object.mask(leaf), ball, object.origin(leaf), region);
    });
    region.shrink();
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
    const std::size_t i = region.find(leaf);
    return i < region.size() && region[i].leaf == leaf ? region[i].mask : kNone;
}

VoxelRegion clipped(const VoxelRegion& region, const ExactSphere& ball, const SampleLevel& object)
{
    VoxelRegion inside(object);
    for (const RegionLeaf part : region) {
        appendClipped(part.leaf, part.mask, ball, object.origin(part.leaf), inside);
    }
    inside.shrink();
    return inside;
}

VoxelRegion unionOf(const VoxelRegion& a, const VoxelRegion& b)
{
    VoxelRegion region = sameObject(a.empty() ? b : a);
    forEachLeafOfBoth(a, b, [&](uint32_t leaf, const LeafMask& inA, const LeafMask& inB) {
        region.append(leaf, inA | inB);
    });
    return region;
}

VoxelRegion unionOf(const std::vector<const VoxelRegion*>& regions)
{
    // Pointers are sorted, as masks are large.
    thread_local std::vector<std::pair<uint32_t, const LeafMask*>> parts;
    parts.clear();
    for (const VoxelRegion* region : regions) {
        for (const RegionLeaf part : *region) parts.emplace_back(part.leaf, &part.mask);
    }
    if (parts.empty()) return {};
    std::sort(
        parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    VoxelRegion united = sameObject(**std::find_if(regions.begin(), regions.end(),
        [](const VoxelRegion* region) { return !region->empty(); }));
    for (std::size_t i = 0; i < parts.size();) {
        const uint32_t leaf = parts[i].first;
        LeafMask mask{};
        for (; i < parts.size() && parts[i].first == leaf; ++i) mask |= *parts[i].second;
        united.append(leaf, mask);
    }
    united.shrink();
    return united;
}

VoxelRegion intersectionOf(const VoxelRegion& a, const VoxelRegion& b)
{
    VoxelRegion region = sameObject(a);
    std::size_t other = 0; // searched, as b may be much larger
    for (const RegionLeaf part : a) {
        other = b.find(part.leaf, other);
        if (other == b.size()) break;
        if (b[other].leaf == part.leaf) region.append(part.leaf, part.mask & b[other].mask);
    }
    return region;
}

VoxelRegion differenceOf(const VoxelRegion& a, const VoxelRegion& b)
{
    VoxelRegion region = sameObject(a);
    std::size_t j = 0;
    for (const RegionLeaf part : a) {
        while (j < b.size() && b[j].leaf < part.leaf) ++j;
        const bool inBoth = j < b.size() && b[j].leaf == part.leaf;
        region.append(part.leaf, inBoth ? part.mask - b[j].mask : part.mask);
    }
    return region;
}

} // namespace openvdb_spheretree::tight
