// SPDX-License-Identifier: Apache-2.0
// The program of docs/tasks/cpp.md: a level set to a sphere-tree, its spheres, and a file of them.

#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb_spheretree/openvdb_spheretree.h>

#include <iostream>

using namespace openvdb_spheretree;

int main()
{
    openvdb::initialize();
    const auto levelSet = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        10.0f, openvdb::Vec3f(0.0f), /*voxelSize=*/0.5f);
    const openvdb::BoolGrid::Ptr object = objectOf(*levelSet); // the voxels inside

    TightOptions options;
    options.quality = Quality::Fast;
    options.budget.spheres = {64, 8, 1};
    SphereTree tree = buildSphereTree(*object, options);
    computeLevelErrors(tree, *object);

    for (const SphereTreeLevel& level : tree.levels) { // level 0, the finest, comes first
        std::cout << level.size() << " spheres, error " << level.error->hammingPercent << " %\n";
        for (int32_t id = level.begin; id < level.end; ++id) {
            std::cout << tree.centerWorld(id) << ", radius " << tree.spheres.radiusWorld[id]
                      << ", parent " << tree.spheres.parent[id] << "\n";
        }
    }
    openvdb::io::File("first_tree.vdb").write({toPoints(tree)});
}
