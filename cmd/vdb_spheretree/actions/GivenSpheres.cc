// SPDX-License-Identifier: Apache-2.0
#include "GivenSpheres.h"

#include "ObjectChoice.h"

#include <openvdb_spheretree/tree/GivenTree.h>
#include <openvdb_spheretree/voxel/BoxSides.h>

#include <cstdio>

namespace command {

namespace {

/// Spheres in millimetres hold any object in metres.
void warnOfUnits(const StackItem& item, const openvdb::BoolGrid& object, Session& session)
{
    constexpr double kOtherUnits = 30; // inches and metres are 39 apart
    openvdb::BBoxd box;
    const openvdb_spheretree::WorldSpheres& spheres = *item.given;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const openvdb::Vec3d reach(spheres.radius[i]);
        box.expand(spheres.center[i] - reach);
        box.expand(spheres.center[i] + reach);
    }
    const openvdb::CoordBBox voxels = object.evalActiveVoxelBoundingBox();
    const double ratio = box.extents().length()
        / (object.voxelSize()[0] * openvdb_spheretree::detail::diagonalOf(voxels));
    if (ratio < kOtherUnits && ratio > 1 / kOtherUnits) return;
    char factor[32];
    std::snprintf(factor, sizeof factor, "%.3g", ratio > 1 ? ratio : 1 / ratio);
    session.warn(item.description() + " are " + factor + " times as "
        + (ratio > 1 ? "large" : "small")
        + " as the object: are they in the same unit (scale= or units= of -read)?");
}

} // namespace

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
    warnOfUnits(item, *object, session);
    item.object = object;
}

} // namespace command
