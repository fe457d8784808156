// SPDX-License-Identifier: Apache-2.0
/// @file DescribeGrid.h
/// @brief How messages name a grid.

#pragma once

#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Grid.h>

#include <string>

namespace openvdb_spheretree::detail {

/// @return "grid 'name'", of a sane length whatever the name.
inline std::string describe(const openvdb::GridBase& grid)
{
    const std::string name = grid.getName();
    return name.empty() ? "the grid without a name" : "grid " + inQuotes(name, 80);
}

} // namespace openvdb_spheretree::detail
