// SPDX-License-Identifier: Apache-2.0
/// @file GyroidShape.h
/// @brief A shell along the gyroid, sin x cos y + sin y cos z + sin z cos x = 0 (A. Schoen 1970),
/// six voxels thick, with a period of 64 voxels, clipped to a box as near to a cube as can be.
///
/// A voxel is on if |F| <= 3 |grad F|, lengths in voxels: to first order, within 3 voxels of the
/// surface F = 0. F is evaluated in integers, from a sine of 12 fractional bits.
///
/// One period is evaluated voxel by voxel, when the shape is made; every leaf is a copy of one of
/// its 512. A shape of any size is counted exactly from the counts of that period.

#pragma once

#include "VoxelRule.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

constexpr int kGyroidPeriod = 64;

/// Whether a voxel of the unbounded gyroid is on.
bool isOnGyroid(const openvdb::Coord& ijk);

class GyroidShape : public LeafwiseRule {
public:
    explicit GyroidShape(int64_t voxels);

    openvdb::CoordBBox box() const override { return mBox; }
    LeafMask leaf(const openvdb::Coord& origin) const override;

private:
    std::vector<LeafMask> mPeriod; ///< leaves of one period, by x, then y, then z
    openvdb::CoordBBox mBox;
};

} // namespace detail
} // namespace openvdb_spheretree
