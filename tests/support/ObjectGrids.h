// SPDX-License-Identifier: Apache-2.0
/// @file ObjectGrids.h
/// @brief What tests of objectOf() share: settings, grids of a name, and why a grid is no object.

#pragma once

#include "Messages.h"

#include <openvdb_spheretree/input/Object.h>

#include <openvdb/openvdb.h>

#include <set>
#include <string>

namespace spheretree_test {

using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;
using openvdb_spheretree::objectOf;
using openvdb_spheretree::ObjectSettings;

inline ObjectSettings threshold(double value)
{
    ObjectSettings settings;
    settings.threshold = value;
    return settings;
}

inline ObjectSettings iso(double value)
{
    ObjectSettings settings;
    settings.iso = value;
    return settings;
}

inline std::set<Coord> voxelsOf(const BoolGrid& grid)
{
    std::set<Coord> voxels;
    for (auto it = grid.cbeginValueOn(); it; ++it) {
        CoordBBox box;
        it.getBoundingBox(box);
        for (const Coord& ijk : box) voxels.insert(ijk);
    }
    return voxels;
}

inline std::string whyNot(const openvdb::GridBase& grid, const ObjectSettings& settings = {})
{
    return messageOf<openvdb::ValueError>([&] { objectOf(grid, settings); });
}

template <typename GridT>
typename GridT::Ptr named(const char* name, const typename GridT::ValueType& background)
{
    const auto grid = GridT::create(background);
    grid->setName(name);
    return grid;
}

} // namespace spheretree_test
