// SPDX-License-Identifier: Apache-2.0
/// @file MengerShape.h
/// @brief A Menger sponge (K. Menger 1926) of voxels that goes on growing from a corner, clipped to
/// a box as near to a cube as can be.
///
/// With coordinates from 0 on written in base 3, a voxel is off if two of its coordinates have the
/// digit 1 in one place. The first 3^k voxels along each axis are a whole sponge of level k, of
/// 20^k voxels; between two of these the number wished for cuts the next one off.

#pragma once

#include "VoxelRule.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

/// @return how many voxels of the sponge lie in the box of these sides, at its corner.
int64_t mengerCount(const openvdb::Coord& sides);

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

} // namespace detail
} // namespace openvdb_spheretree
