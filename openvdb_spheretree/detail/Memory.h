// SPDX-License-Identifier: Apache-2.0
/// @file detail/Memory.h
/// @brief An error in good time, in place of a machine that swaps or a process that is killed.

#pragma once

#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

/// @throw openvdb::ValueError if @a leaves leaf nodes at @a bytesPerLeaf are more than this
///        machine's physical memory (where that can be told)
void requireMemory(int64_t leaves, int64_t bytesPerLeaf);

} // namespace detail
} // namespace openvdb_spheretree
