// SPDX-License-Identifier: Apache-2.0
/// @file FloorDiv.h
/// @brief Division rounded down, also below zero.

#pragma once

namespace openvdb_spheretree {
namespace detail {

/// @param b  1 or more
inline int floorDiv(int a, int b) { return a >= 0 ? a / b : -1 - (-1 - a) / b; }

} // namespace detail
} // namespace openvdb_spheretree
