// SPDX-License-Identifier: Apache-2.0
/// @file NoiseShape.h
/// @brief Single voxels at random: each voxel of a box is on with a probability of 1%, by a hash of
/// its coordinates and the seed.

#pragma once

#include "NearCube.h"
#include "VoxelRule.h"
#include <openvdb_spheretree/base/Hash.h>

#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

class NoiseShape : public LeafwiseRule {
public:
    static constexpr int kVoxelsPerOne = 100; ///< of the box, for one that is on

    NoiseShape(int64_t voxels, uint64_t seed)
        : mKey(hash(seed)), mBox(boxOfSides(nearCubeOf(voxels, [](const openvdb::Coord& sides) {
              return int64_t(sides[0]) * sides[1] * sides[2] / kVoxelsPerOne;
          })))
    {}

    openvdb::CoordBBox box() const override { return mBox; }

    bool isOn(const openvdb::Coord& ijk) const { return isOn(placeOf(ijk[0], ijk[1], ijk[2])); }

    LeafMask leaf(const openvdb::Coord& origin) const override
    {
        LeafMask mask;
        for (int x = 0; x < kLeafDim; ++x) {
            const uint64_t first = placeOf(origin[0] + x, origin[1], origin[2]);
            uint64_t word = 0;
            for (int n = 0; n < 64; ++n) {
                word |= uint64_t(isOn(first | placeOf(0, n >> 3, n & 7))) << n;
            }
            mask[x] = word;
        }
        return mask;
    }

private:
    /// Coordinates side by side: 0 to 2^21 - 1 each.
    static uint64_t placeOf(int x, int y, int z)
    {
        constexpr int kBits = 21;
        return uint64_t(x) << (2 * kBits) | uint64_t(y) << kBits | uint64_t(z);
    }
    bool isOn(uint64_t place) const { return hash(mKey ^ place) < ~uint64_t(0) / kVoxelsPerOne; }

    uint64_t mKey;
    openvdb::CoordBBox mBox;
};

} // namespace detail
} // namespace openvdb_spheretree
