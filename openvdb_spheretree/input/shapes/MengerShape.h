// SPDX-License-Identifier: Apache-2.0
/// @file MengerShape.h
/// @brief A Menger sponge (K. Menger 1926) of voxels without end from a corner on, clipped to a
/// near-cube (nearCubeOf()).
///
/// Coordinates are 0 or more. A voxel is off if, written in base 3, two of its coordinates have the
/// digit 1 in the same place. The first 3^k voxels along each axis are a whole sponge of level k,
/// of 20^k voxels. A box of any other size cuts through a larger sponge.

#pragma once

#include "VoxelRule.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

class MengerShape : public LeafwiseRule {
public:
    explicit MengerShape(int64_t voxels);

    openvdb::CoordBBox box() const override { return mBox; }
    /// None in the large holes.
    Filling filling(const openvdb::CoordBBox& cube) const override;
    LeafMask leaf(const openvdb::Coord& origin) const override;

private:
    openvdb::CoordBBox mBox;
    std::vector<uint32_t> mOnes; ///< of a coordinate: a bit for each digit that is 1
};

} // namespace openvdb_spheretree::detail
