// SPDX-License-Identifier: Apache-2.0
/// @file GyroidShape.h
/// @brief A shell along the gyroid, sin x cos y + sin y cos z + sin z cos x = 0 (A. Schoen 1970).
/// It is six voxels thick, has a period of 64 voxels, and is clipped to a near-cube (nearCubeOf()).
///
/// With F the left side, a voxel is on if |F| <= 3 |grad F|: to first order, it is within 3 voxels
/// of the surface F = 0. F is evaluated in integers, from a sine of 12 fractional bits.
///
/// The constructor evaluates one period voxel by voxel. Every leaf is a copy of one of the 512
/// leaves of that period, and a box of any size is counted exactly from its counts.

#pragma once

#include "VoxelRule.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

class GyroidShape : public LeafwiseRule {
public:
    explicit GyroidShape(int64_t voxels);

    openvdb::CoordBBox box() const override { return mBox; }
    LeafMask leaf(const openvdb::Coord& origin) const override;

private:
    std::vector<LeafMask> mPeriod; ///< leaves of one period, by x, then y, then z
    openvdb::CoordBBox mBox;
};

} // namespace openvdb_spheretree::detail
