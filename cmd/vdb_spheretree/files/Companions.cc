// SPDX-License-Identifier: Apache-2.0
#include "Companions.h"

#include <openvdb_spheretree/store/SphereTreePoints.h>

namespace command {

using openvdb::points::PointDataGrid;

CompanionIndex::CompanionIndex(const openvdb::GridPtrVec& grids)
{
    for (const openvdb::GridBase::Ptr& grid : grids) {
        if (auto points = openvdb::gridPtrCast<PointDataGrid>(grid)) {
            mByName[grid->getName()].push_back(points);
        }
    }
}

Companions CompanionIndex::of(const std::string& tree) const
{
    const auto first = [&](const char* suffix, const auto& claims) -> PointDataGrid::Ptr {
        const auto found = mByName.find(tree + suffix);
        if (found == mByName.end()) return nullptr;
        for (const PointDataGrid::Ptr& grid : found->second) {
            if (claims(*grid, tree)) return grid;
        }
        return nullptr;
    };
    return {
        first("_dag", openvdb_spheretree::isDagOf), first("_cuts", openvdb_spheretree::isCutsOf)};
}

} // namespace command
