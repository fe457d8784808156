// SPDX-License-Identifier: Apache-2.0
/// @file NearestObject.h
/// @brief The object that spheres are to be near to, and what they have wrong of it, counted exactly.
///
/// Cost: of the counts, with the surface of the spheres and of the object (SphereUnion.h); of missingBalls(), linear
/// in the missing voxels. Tests: TestNearestSearch.cc.

#pragma once

#include <openvdb_spheretree/sphere/ExactSphere.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::nearest {

/// Spheres are in 1/16 voxel (FineSphere.h).
struct NearestObject {
    const openvdb::MaskTree& voxels;     ///< if dim is 2, all with z = 0
    const tight::SampledObject& samples; ///< of the same voxels
    int64_t voxelCount;
    int dim;        ///< 2: spheres are discs in the plane z = 0
    int64_t memory; ///< SphereTreeSettings::memory
    openvdb::util::NullInterrupter* interrupter;
};

/// @return excess + missing of some spheres, in voxels.
int64_t wrongVoxels(const NearestObject& object, const std::vector<ExactSphere>& spheres);

/// @return the first inner spheres (InnerOrder.h) of what @a spheres miss, @a most or fewer. Each of them alone would
///         make less wrong.
std::vector<ExactSphere> missingBalls(
    const NearestObject& object, const std::vector<ExactSphere>& spheres, int64_t most);

} // namespace openvdb_spheretree::nearest
