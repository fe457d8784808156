// SPDX-License-Identifier: Apache-2.0
/// @file PowerCull.h
/// @brief Which of the balls that reach into a cube can add a voxel there to the others.
///
/// A ball holds voxel q where its power radiusSq - |2^shift q - center|^2 is not negative. The
/// powers of two balls differ by a linear function of q. So if one power is the larger at all
/// corners of a cube, it is in all of the cube, and the other ball adds nothing there. The signs of
/// the function's factors tell which corner decides. (Thousands of medial balls reach into a leaf
/// on the surface of a solid, and a few dozen of them determine its voxels.)
///
/// Balls are compared only with those of largest power at the cube's center and corners: some that
/// add nothing may be left. Exact. Cost: linear in the balls.

#pragma once

#include "ClippedSphere.h"

#include <array>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

class PowerCull {
public:
    /// @param list    balls, by index, that reach into the cube, all of the same clip and units.
    ///                Those that add nothing are removed; the others keep their order.
    /// @param origin  of the cube, whose side has @a size voxels
    void cull(const ClippedSphere* balls, const int32_t origin[3], int32_t size,
        std::vector<int32_t>& list);

private:
    /// From the cube's center.
    struct Entry {
        int64_t power; ///< there
        std::array<int64_t, 3> center;
    };
    static constexpr std::size_t kPlaces = 9; ///< center and corners
    using Champions = std::array<std::size_t, kPlaces>;

    bool collect(const ClippedSphere* balls, const int32_t origin[3], int32_t size,
        const std::vector<int32_t>& list);
    Champions champions(int64_t reach) const;
    bool exceeded(std::size_t entry, const Champions& champions, int64_t reach) const;

    std::vector<Entry> mEntries;
};

} // namespace openvdb_spheretree::detail
