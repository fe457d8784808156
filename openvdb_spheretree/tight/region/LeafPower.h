// SPDX-License-Identifier: Apache-2.0
/// @file LeafPower.h
/// @brief Which of a few balls has the most power at each voxel of a leaf.

#pragma once

#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/voxel/LeafMask.h>

#include <openvdb/math/Coord.h>

#include <array>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// A ball, and the voxels of the leaf that it may claim.
struct LeafClaim {
    const ExactSphere* ball;
    const LeafMask* within;
};

/// @param origin  of the leaf
/// @param claims  of equal powers the first one has the voxel
/// @return for each voxel the claim with the most power, radiusSq - distance^2, by its place in
///         @a claims; -1 where none has a power of 0 or more: no ball holds the voxel.
std::array<int64_t, kLeafVoxels> strongestClaims(
    const openvdb::Coord& origin, const std::vector<LeafClaim>& claims);

} // namespace openvdb_spheretree::tight
