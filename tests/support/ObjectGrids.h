// SPDX-License-Identifier: Apache-2.0
/// @file ObjectGrids.h
/// @brief What tests of objectMask() share: settings, grids of a name, and why a grid is no object.

#pragma once

#include "Messages.h"

#include <openvdb_spheretree/input/ObjectMask.h>

#include <openvdb/openvdb.h>

#include <set>
#include <string>

namespace spheretree_test {

using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;
using openvdb_spheretree::objectMask;
using openvdb_spheretree::ObjectMaskSettings;

inline ObjectMaskSettings threshold(double value)
{
    ObjectMaskSettings settings;
    settings.threshold = value;
    return settings;
}

inline ObjectMaskSettings iso(double value)
{
    ObjectMaskSettings settings;
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

inline std::string whyNot(const openvdb::GridBase& grid, const ObjectMaskSettings& settings = {})
{
    return messageOf<openvdb::ValueError>([&] { objectMask(grid, settings); });
}

template <typename GridT>
typename GridT::Ptr named(const char* name, const typename GridT::ValueType& background)
{
    const auto grid = GridT::create(background);
    grid->setName(name);
    return grid;
}

} // namespace spheretree_test
