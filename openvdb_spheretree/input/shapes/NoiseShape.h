// SPDX-License-Identifier: Apache-2.0
/// @file NoiseShape.h
/// @brief Single voxels at random: each voxel of a box is on with a probability of 1%, by a hash of
/// its coordinates and the seed.

#pragma once

#include "VoxelRule.h"
#include <openvdb_spheretree/base/Hash.h>

#include <cstdint>

namespace openvdb_spheretree::detail {

class NoiseShape : public LeafwiseRule {
public:
    static constexpr int kVoxelsPerOne = 100; ///< of the box, for one that is on

    NoiseShape(int64_t voxels, uint64_t seed)
        : mKey(hash(seed)), mBox(nearCubeOf(voxels, [](const openvdb::Coord& sides) {
              return int64_t(sides[0]) * sides[1] * sides[2] / kVoxelsPerOne;
          }))
    {}

    openvdb::CoordBBox box() const override { return mBox; }
    LeafMask leaf(const openvdb::Coord& origin) const override
    {
        const uint64_t first = placeOf(origin[0], origin[1], origin[2]);
        LeafMask mask{};
        for (uint32_t n = 0; n < kLeafVoxels; ++n) {
            const uint64_t place = first | placeOf(n >> 6, n >> 3 & 7, n & 7);
            if (hash(mKey ^ place) < ~uint64_t(0) / kVoxelsPerOne) mask.setOn(n);
        }
        return mask;
    }

private:
    /// Coordinates side by side: 0 to 2^21 - 1 each.
    static uint64_t placeOf(uint32_t x, uint32_t y, uint32_t z)
    {
        constexpr int kBits = 21;
        return uint64_t(x) << (2 * kBits) | uint64_t(y) << kBits | uint64_t(z);
    }

    uint64_t mKey;
    openvdb::CoordBBox mBox;
};

} // namespace openvdb_spheretree::detail
