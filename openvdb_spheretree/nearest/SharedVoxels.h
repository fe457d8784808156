// SPDX-License-Identifier: Apache-2.0
/// @file SharedVoxels.h
/// @brief How many voxels two spheres have in common, and the parents that follow: of each sphere the one of the next
/// level that shares most voxels with it.
///
/// Exact. Cost: of a pair, a square root for each row of the smaller sphere. Tests: TestNearestTree.cc, against
/// counting voxel by voxel.

#pragma once

#include <openvdb_spheretree/sphere/ExactSphere.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::nearest {

/// @param flat  only those with z = 0
/// @return the voxels that lie in both spheres, which are in 1/16 voxel.
int64_t sharedVoxels(const ExactSphere& a, const ExactSphere& b, bool flat);

/// @param above  one or more
/// @return for each of @a spheres the index in @a above: of equals the first; where none shares a voxel, the one with
///         the smallest gap for its size (BallGrid::nearest()).
std::vector<int32_t> parentsOf(const std::vector<ExactSphere>& spheres,
    const std::vector<ExactSphere>& above, bool flat, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::nearest
