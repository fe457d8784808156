// SPDX-License-Identifier: Apache-2.0
/// @file MaxPlus.h
/// @brief The kernel of the power map, on rows of 64 lines (see LeafRows.h).
///
/// A voxel's value and the radiusSq of the site it came from travel as one integer, the *key*:
/// value in the upper bits, site radiusSq below. One comparison then decides by value first and by
/// radiusSq among equals, which is the tie rule; the place along the axis decides last, because the
/// first of equal rows wins.
///
/// Where radii are small, as nearly everywhere, there is room for that place in the key as well:
/// the offset to the site, counted downwards so that the first row is the largest. A candidate then
/// costs one subtraction and one max. The kernel turns keys into that form, and back, for each run
/// whose radii allow it (SmallKeys in MaxPlus.cc, where bits are counted).

#pragma once

#include "LeafRows.h"

#include <cstdint>

namespace openvdb_spheretree::detail {

/// Keys and offsets for radii up to 127 voxels: offsets fit 8 bits, values 14 (127^2 < 2^14).
struct NarrowPower {
    using Key = int32_t;
    using Offset = int8_t;
    static constexpr int kShift = 16;
    static constexpr uint32_t kMaxRadiusSq = 127 * 127;
};

/// The same for radii up to 32767 voxels: offsets fit 16 bits, values 30.
struct WidePower {
    using Key = int64_t;
    using Offset = int16_t;
    static constexpr int kShift = 32;
    static constexpr uint32_t kMaxRadiusSq = 32767u * 32767u;
};

/// The key of a voxel that a site of radius^2 @a siteSq covers by @a value; 0 for background.
template <typename Power>
typename Power::Key powerKey(uint32_t value, uint32_t siteSq)
{
    using Key = typename Power::Key;
    return value ? (Key(value) << Power::kShift) | Key(siteSq) : 0;
}

/// @return the radiusSq of the site of a key.
template <typename Power>
uint32_t siteSqOf(typename Power::Key key)
{
    return uint32_t(uint64_t(key) & ((uint64_t(1) << Power::kShift) - 1));
}

/// @brief outKey(i) = max over j of inKey(j) with (i - j)^2 taken off its value; offset(i) = j - i
/// for the first such j. Background (key 0) stays 0 with offset 0, and cuts its line. For that, a
/// value must be at most the squared distance to the next background on its line. It is: let q have
/// the value distSq(p) - |p - q|^2 of a site p that differs from q along earlier axes only, and let
/// b be background t rows from q along this one. No ball holds background, so
/// distSq(p) <= |p - b|^2 = |p - q|^2 + t^2, and the value is at most t^2.
/// @param inKey   row -1 and the row behind the last are readable and zero
/// @param outKey  may be null when only the offsets are wanted
/// @param rows    results are for its range; others of outKey and offset stay as they are
template <typename Power>
void maxPlus(const typename Power::Key* inKey, typename Power::Key* outKey,
    typename Power::Offset* offset, const RowRange& rows, EnvelopeScratch& scratch);

/// @brief The same for the first axis, where every voxel is its own site: keys from squared
/// distances.
/// @param distances  those of rows.count rows
/// @return the largest of them.
template <typename Power, typename T>
uint32_t firstMaxPlus(const T* distances, typename Power::Key* outKey,
    typename Power::Offset* offset, int rows, EnvelopeScratch& scratch);

} // namespace openvdb_spheretree::detail
