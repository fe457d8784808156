// SPDX-License-Identifier: Apache-2.0
/// @file main.cc
/// @brief A level set to a sphere-tree to VDB points, from outside the project.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/input/ObjectMask.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <openvdb/openvdb.h>
#include <openvdb/points/PointCount.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <iostream>

int main()
{
    openvdb::initialize();
    const auto levelSet = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        10.0f, openvdb::Vec3f(0.0f), /*voxelSize=*/0.5f);
    const auto object = openvdb_spheretree::objectMask(*levelSet);
    const auto tree = openvdb_spheretree::buildSphereTree(*object);
    const auto points = openvdb_spheretree::toPoints(tree);
    for (const auto& level : tree.levels) {
        std::cout << "level " << level.level << ": " << level.size() << " spheres\n";
    }
    return openvdb::points::pointCount(points->tree()) == openvdb::Index64(tree.size()) ? 0 : 1;
}
