// SPDX-License-Identifier: Apache-2.0
/// @file main.cc
/// @brief A level set to a sphere-tree, the leaf spheres that hold a point, and VDB points to
/// store, from outside the project.

#include <openvdb_spheretree/openvdb_spheretree.h>

#include <openvdb/openvdb.h>
#include <openvdb/points/PointCount.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <iostream>

namespace spheretree = openvdb_spheretree;

int main()
{
    openvdb::initialize();
    const auto levelSet = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        10.0f, openvdb::Vec3f(0.0f), /*voxelSize=*/0.5f);
    const auto object = spheretree::objectOf(*levelSet);
    const auto tree = spheretree::buildSphereTree(*object);
    for (const auto& level : tree.levels) {
        std::cout << "level " << level.level << ": " << level.size() << " spheres\n";
    }

    // The spheres of level 0 around a voxel of the object, by way of those of the levels above.
    const openvdb::Vec3d point(3, 4, 0); // world space
    const auto rows = spheretree::children(tree);
    int visited = 0, holding = 0;
    spheretree::visitSpheres(tree, rows, [&](int32_t id) {
        ++visited;
        const double radius = tree.spheres.radiusWorld[id];
        if ((tree.centerWorld(id) - point).length() > radius) return false;
        holding += tree.levelOf(id) == 0;
        return true;
    });
    std::cout << holding << " leaf spheres hold " << point << ", found among " << visited << " of "
              << tree.size() << " spheres\n";

    const auto points = spheretree::toPoints(tree);
    const bool stored =
        openvdb::points::pointCount(points->tree()) == openvdb::Index64(tree.size());
    return stored && holding > 0 ? 0 : 1;
}
