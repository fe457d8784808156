// SPDX-License-Identifier: Apache-2.0
/// @file LargestValue.h
/// @brief The largest of many values.

#pragma once

#include <cstddef>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// @param count  a multiple of 64
/// @return 0 if there are none.
uint32_t largestValue(const uint16_t* values, std::size_t count);
uint32_t largestValue(const uint32_t* values, std::size_t count);

} // namespace openvdb_spheretree::detail
