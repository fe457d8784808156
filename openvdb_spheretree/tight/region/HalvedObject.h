// SPDX-License-Identifier: Apache-2.0
/// @file HalvedObject.h
/// @brief The object at half the resolution, the next level of its OR-pyramid, with balls and
/// regions of it.

#pragma once

#include "VoxelRegion.h"
#include <openvdb_spheretree/pyramid/LeafCoarsener.h>
#include <openvdb_spheretree/pyramid/PyramidModel.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

class HalvedObject {
public:
    /// @param object  outlives it
    /// @param flat    z stays as it is
    HalvedObject(const SampleLevel& object, bool flat);
    HalvedObject(const HalvedObject&) = delete; // regions refer to it

    const SampledObject& object() const { return mHalved; }
    /// From the object to this one.
    const PyramidStep& step() const { return mStep; }

    /// @return the parents of the voxels of a region.
    VoxelRegion regionOf(const VoxelRegion& fine) const;
    /// @return a ball of radius 0 at the center of a ball, rounded.
    ExactSphere centerOf(const ExactSphere& fine) const;

private:
    const SampleLevel& mFine;
    const PyramidStep mStep;
    const detail::LeafCoarsener mCoarsener;
    std::vector<uint32_t> mParentLeaf; ///< of each leaf of the object the leaf here
    SampledObject mHalved;
};

} // namespace openvdb_spheretree::tight
