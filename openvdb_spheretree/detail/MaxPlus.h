// SPDX-License-Identifier: Apache-2.0
/// @file detail/MaxPlus.h
/// @brief The kernel of the power map, on rows of 64 lines (see LeafRows.h).
///
/// A voxel's value and the radiusSq of the site it came from travel as one integer, the *key*:
/// value in the upper half, site radiusSq in the lower. One comparison then decides by value first
/// and by radiusSq among equals, which is the tie rule; the place along the axis decides last,
/// because the first of equal rows wins.

#pragma once

#include "EnvelopeScratch.h"

#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

/// Keys and offsets for radii up to 127 voxels.
struct NarrowPower {
    using Key = int32_t;
    using Offset = int8_t;
    static constexpr int kShift = 16;
    static constexpr uint32_t kMaxRadiusSq = 127 * 127;
};

/// Keys and offsets for radii up to 32767 voxels.
struct WidePower {
    using Key = int64_t;
    using Offset = int16_t;
    static constexpr int kShift = 32;
    static constexpr uint32_t kMaxRadiusSq = 32767u * 32767u;
};

template <typename Power>
typename Power::Key powerKey(uint32_t distSq)
{
    return (typename Power::Key(distSq) << Power::kShift) | distSq;
}

/// @brief outKey(i) = max over j of inKey(j) with (i - j)^2 taken off its value; offset(i) = j - i
/// for the first such j. Background (key 0) stays 0 with offset 0, and cuts its line: a value must
/// be at most the squared distance to the next background on its line, as distances, and what the
/// passes before leave of them, are.
/// @param inKey   row -1 and row `rows` are readable and zero
/// @param outKey  may be null when only the offsets are wanted
/// @param rows    a multiple of 8
void maxPlus(
    const int32_t* inKey, int32_t* outKey, int8_t* offset, int rows, EnvelopeScratch& scratch);
void maxPlus(
    const int64_t* inKey, int64_t* outKey, int16_t* offset, int rows, EnvelopeScratch& scratch);

} // namespace detail
} // namespace openvdb_spheretree
