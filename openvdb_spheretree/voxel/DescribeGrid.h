// SPDX-License-Identifier: Apache-2.0
/// @file DescribeGrid.h
/// @brief How messages name a grid.

#pragma once

#include <openvdb/Grid.h>

#include <string>

namespace openvdb_spheretree {
namespace detail {

/// @return "grid 'name'", of a sane length whatever the name.
inline std::string describe(const openvdb::GridBase& grid)
{
    constexpr std::size_t kLongest = 80;
    const std::string name = grid.getName();
    if (name.empty()) return "the grid without a name";
    return "grid '" + (name.size() > kLongest ? name.substr(0, kLongest) + "..." : name) + "'";
}

} // namespace detail
} // namespace openvdb_spheretree
