// SPDX-License-Identifier: Apache-2.0
// A die that turns as it falls onto a ball: where is it when they first touch, and how near has it been before?

#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetPlatonic.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb_spheretree/openvdb_spheretree.h>

#include <iostream>

using namespace openvdb_spheretree;

QueryTree queryTree(const openvdb::FloatGrid& levelSet)
{
    TightOptions options;
    options.quality = Quality::Fast;
    return makeQueryTree(buildSphereTree(*objectOf(levelSet), options));
}

int main()
{
    openvdb::initialize();
    const openvdb::Vec3f origin(0.0f);
    const QueryTree ball =
        queryTree(*openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(1.0f, origin, 0.05f));
    const QueryTree die = queryTree(
        *openvdb::tools::createLevelSetPlatonic<openvdb::FloatGrid>(6, 1.0f, origin, 0.05f));

    for (double height = 4; height > 0; height -= 0.1) {
        const auto turn = RigidTransform::fromRotation({1, 2, 0}, height);
        const auto pose = RigidTransform::fromTranslation({0.3, 0, height}) * turn;
        if (collide(ball, {}, die, pose).isCollision()) {
            std::cout << "they touch at " << height << "\n";
            return height > 1 && height < 2.2 ? 0 : 1;
        }
        const DistanceResult near = distance(ball, {}, die, pose);
        std::cout << "at " << height << " they are " << near.objectsLower << " to "
                  << near.objectsUpper << " apart, nearest at " << near.contact->point() << "\n";
    }
    return 1; // it has fallen through
}
