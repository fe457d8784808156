// SPDX-License-Identifier: Apache-2.0
/// @file ObjectGrids.h
/// @brief What tests of objectOf() share: settings, grids of a name, and why a grid is no object.

#pragma once

#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/voxel/MakeGrid.h>

#include <set>
#include <string>

namespace spheretree_test {

using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;
using openvdb_spheretree::objectOf;
using openvdb_spheretree::ObjectSettings;

ObjectSettings threshold(double value);

ObjectSettings iso(double value);

std::set<Coord> voxelsOf(const BoolGrid& grid);

std::string whyNot(const openvdb::GridBase& grid, const ObjectSettings& settings = {});

template <typename GridT>
typename GridT::Ptr named(const char* name, const typename GridT::ValueType& background)
{
    const auto grid = openvdb_spheretree::detail::makeGrid<GridT>();
    grid->tree().root().setBackground(background, /*updateChildNodes=*/false);
    grid->setName(name);
    return grid;
}

} // namespace spheretree_test
