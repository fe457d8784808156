// SPDX-License-Identifier: Apache-2.0
/// @file MinPlus.h
/// @brief The kernel of the distance transform, on rows of 64 lines (see LeafRows.h).

#pragma once

#include "LeafRows.h"

#include <cstdint>

namespace openvdb_spheretree::detail {

/// Results are exact if all of them are below this. If one is not, others may be wrong as well, and
/// the pass has to be done again in a wider type. Penalties are clamped: to 2^16 - 1, where sums
/// saturate, and in 32 bits to kWideMax < 2^31, so that a sum of two values stays below 2^32.
constexpr uint32_t kNarrowMax = 255 * 255;     ///< of 16-bit values
constexpr uint32_t kWideMax = 46340u * 46340u; ///< of 32-bit values

/// @brief out(i) = min over j of in(j) + (i - j)^2.
/// @param in     row -1 and row `rows` are readable and zero, as the background there
/// @param rows   a multiple of 8
void minPlus(const uint16_t* in, uint16_t* out, int rows, EnvelopeScratch& scratch);
void minPlus(const uint32_t* in, uint32_t* out, int rows, EnvelopeScratch& scratch);

} // namespace openvdb_spheretree::detail
