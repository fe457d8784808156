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
    : mFine(object), mStep(halving(flat)), mCoarsener(mStep), mParentLeaf(object.leafCount())
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
        mParentLeaf[leaf] = uint32_t(parent - sorted.begin());
        mCoarsener.add(object.mask(leaf), object.origin(leaf), *parent, masks[mParentLeaf[leaf]]);
    }
    mHalved = SampledObject(SampleLevel(std::move(sorted), std::move(masks)), flat);
}

VoxelRegion HalvedObject::regionOf(const VoxelRegion& fine) const
{
    const SampleLevel& voxels = mHalved.level(0);
    VoxelRegion halved(voxels);
    std::vector<std::pair<uint32_t, std::size_t>> parts; // by the leaf that their parents are in
    for (std::size_t i = 0; i < fine.size(); ++i) parts.emplace_back(mParentLeaf[fine[i].leaf], i);
    std::sort(parts.begin(), parts.end());
    for (std::size_t k = 0; k < parts.size();) {
        const uint32_t leaf = parts[k].first;
        LeafMask mask{};
        for (; k < parts.size() && parts[k].first == leaf; ++k) {
            const RegionLeaf part = fine[parts[k].second];
            mCoarsener.add(part.mask, mFine.origin(part.leaf), voxels.origin(leaf), mask);
        }
        halved.append(leaf, mask);
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
