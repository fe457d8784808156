// SPDX-License-Identifier: Apache-2.0
#include "GivenSpheres.h"

#include "ObjectChoice.h"

#include <openvdb_spheretree/tree/GivenTree.h>
#include <openvdb_spheretree/voxel/BoxSides.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <cstdio>

namespace command {

void warnOfUnits(const std::string& what, double size, double object, Session& session)
{
    constexpr double kOtherUnits = 50; // inches and metres are 39 apart, and wrong anyhow
    const double ratio = size / object;
    if (!(ratio > kOtherUnits || ratio < 1 / kOtherUnits)) return;
    const bool larger = ratio > 1;
    char factor[32];
    std::snprintf(factor, sizeof factor, "%.3g", larger ? ratio : 1 / ratio);
    session.warn(what + " " + factor + " times as " + (larger ? "large" : "small")
        + " as the object: are they in the same unit (scale= or units= of -read)?");
}

void placeInObject(StackItem& item, Session& session, const std::string& ageOrName)
{
    if (!item.given || (item.object && ageOrName.empty())) return;
    StackItem* const grid =
        ageOrName.empty() ? onlyObjectGrid(session) : &selectObjectGrid(session, ageOrName);
    if (!grid) return;
    const Stopwatch watch;
    const openvdb::BoolGrid::ConstPtr object = objectOf(*grid, {}, session);
    session.seconds.mask += watch.seconds();
    const std::string name = item.tree->settings.name; // -level may have given it another
    try {
        item.tree = std::make_shared<openvdb_spheretree::SphereTree>(
            openvdb_spheretree::givenTree(*item.given, *object));
    } catch (...) {
        rethrowNamed(item.description(), kInput);
    }
    item.tree->settings.name = name;
    const openvdb::CoordBBox voxels = object->evalActiveVoxelBoundingBox();
    warnOfUnits(item.description() + " are",
        openvdb_spheretree::boxOf(*item.given).extents().length(),
        openvdb_spheretree::voxelSizeOf(object->transform())
            * openvdb_spheretree::detail::diagonalOf(voxels),
        session);
    item.object = object;
}

} // namespace command
