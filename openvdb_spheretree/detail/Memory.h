// SPDX-License-Identifier: Apache-2.0
/// @file detail/Memory.h
/// @brief An error in good time, in place of a machine that swaps or a process that is killed.

#pragma once

#include <cstdint>
#include <string>

namespace openvdb_spheretree {
namespace detail {

/// @return the bytes of this machine; 0 if they are not known.
double physicalMemory();

/// @throw openvdb::ValueError if @a leaves leaf nodes at @a bytesPerLeaf are more than this
///        machine's physical memory (where that can be told)
void requireMemory(int64_t leaves, int64_t bytesPerLeaf);

/// @brief The same for anything else.
/// @param what    what needs that much, as the subject (plural) of the message
/// @param remedy  what one can do
void requireMemory(double bytes, const std::string& what, const std::string& remedy);

} // namespace detail
} // namespace openvdb_spheretree
