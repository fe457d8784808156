// SPDX-License-Identifier: Apache-2.0
/// @file MakeGrid.h
/// @brief An empty grid of numbers, made by the code in OpenVDB's library.

#pragma once

#include <openvdb/openvdb.h>

namespace openvdb_spheretree::detail {

/// @return a grid of background 0. GridT::create() is the same, but compiles the grid's virtual
/// functions anew: nine seconds a file.
template <typename GridT>
typename GridT::Ptr makeGrid()
{
    openvdb::initialize(); // the grid's type is found by its name
    return openvdb::gridPtrCast<GridT>(openvdb::GridBase::createGrid(GridT::gridType()));
}

} // namespace openvdb_spheretree::detail
