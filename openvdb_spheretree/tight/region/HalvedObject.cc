// SPDX-License-Identifier: Apache-2.0
#include "HalvedObject.h"

#include <algorithm>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

PyramidStep halving(bool flat)
{
    PyramidStep step;
    step.dim = flat ? 2 : 3;
    return step;
}

} // namespace

HalvedObject::HalvedObject(const SampleLevel& object, bool flat)
    : mFine(object), mStep(halving(flat)), mCoarsener(mStep), mParent(object.leafCount())
{
    // A leaf of 8^3 voxels starts at an even one, so it has all its parents in one leaf.
    std::vector<openvdb::Coord> origins;
    for (std::size_t leaf = 0; leaf < object.leafCount(); ++leaf) {
        origins.push_back(mCoarsener.parentLeaves(object.origin(leaf)).min());
    }
    std::vector<openvdb::Coord> sorted(origins);
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    std::vector<LeafMask> masks(sorted.size(), LeafMask{});
    for (std::size_t leaf = 0; leaf < object.leafCount(); ++leaf) {
        const auto parent = std::lower_bound(sorted.begin(), sorted.end(), origins[leaf]);
        mParent[leaf] = uint32_t(parent - sorted.begin());
        mCoarsener.add(object.mask(leaf), object.origin(leaf), *parent, masks[mParent[leaf]]);
    }
    mHalved = SampledObject(SampleLevel(std::move(sorted), std::move(masks)));
}

VoxelRegion HalvedObject::regionOf(const VoxelRegion& fine) const
{
    VoxelRegion halved;
    const SampleLevel& voxels = mHalved.level(0);
    std::vector<std::pair<uint32_t, const RegionLeaf*>> parts;
    for (const RegionLeaf& part : fine) parts.emplace_back(mParent[part.leaf], &part);
    std::sort(parts.begin(), parts.end());
    for (const auto& [leaf, part] : parts) {
        if (halved.empty() || halved.back().leaf != leaf) halved.push_back({leaf, LeafMask{}});
        mCoarsener.add(
            part->mask, mFine.origin(part->leaf), voxels.origin(leaf), halved.back().mask);
    }
    return halved;
}

ExactSphere HalvedObject::centerOf(const ExactSphere& fine) const
{
    // A parent's children are its middle plus or minus half a voxel along each axis that is halved.
    constexpr int64_t kHalf = kFine / 2;
    ExactSphere ball = fine;
    for (int a = 0; a < mStep.dim; ++a) ball.center[a] = (fine.center[a] - kHalf) >> 1;
    ball.radiusSq = 0;
    return ball;
}

} // namespace openvdb_spheretree::tight
