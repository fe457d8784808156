// SPDX-License-Identifier: Apache-2.0
#include "ObjectGrids.h"

#include "Messages.h"

#include <openvdb_spheretree/voxel/MaskGrids.h>

namespace spheretree_test {

ObjectSettings threshold(double value)
{
    ObjectSettings settings;
    settings.threshold = value;
    return settings;
}

ObjectSettings iso(double value)
{
    ObjectSettings settings;
    settings.iso = value;
    return settings;
}

std::set<Coord> voxelsOf(const BoolGrid& grid)
{
    std::set<Coord> voxels;
    for (auto it = grid.cbeginValueOn(); it; ++it) {
        CoordBBox box;
        it.getBoundingBox(box);
        for (const Coord& ijk : box) voxels.insert(ijk);
    }
    return voxels;
}

std::string whyNot(const openvdb::GridBase& grid, const ObjectSettings& settings)
{
    return messageOf<openvdb::ValueError>([&] { objectOf(grid, settings); });
}

} // namespace spheretree_test
