// SPDX-License-Identifier: Apache-2.0
#include "LevelSpheres.h"

#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {

SphereMetric metricOf(const SphereTree& tree) { return {tree.settings.dist(), tree.subdivision}; }

std::vector<ExactSphere> levelSpheres(const SphereTree& tree, const SphereTreeLevel& level)
{
    std::vector<ExactSphere> spheres;
    spheres.reserve(level.size());
    for (int32_t id = level.begin; id < level.end; ++id) {
        const openvdb::Vec3d c =
            tree.spheres.center[id] * double(tree.subdivision); // exact: a power of two
        spheres.push_back({{std::llround(c[0]), std::llround(c[1]), std::llround(c[2])},
            tree.spheres.coverRadiusSq[id]});
    }
    return spheres;
}

double storedRadiusVoxels(const SphereTree& tree, int32_t id)
{
    constexpr double kRounding = 1 + 1e-12;
    return double(tree.spheres.radiusWorld[id]) / tree.voxelSize() * kRounding;
}

std::vector<ExactSphere> storedSpheres(const SphereTree& tree, const SphereTreeLevel& level)
{
    constexpr double kMostSq = 0x1p62; // of squared radii
    const double unit = double(tree.subdivision) * tree.settings.dist().unit();
    std::vector<ExactSphere> spheres = levelSpheres(tree, level);
    for (int32_t id = level.begin; id < level.end; ++id) {
        const double reach = unit * storedRadiusVoxels(tree, id);
        spheres[id - level.begin].radiusSq = int64_t(std::min(reach * reach, kMostSq));
    }
    return spheres;
}

openvdb::CoordBBox levelBox(const SphereTree& tree, const std::vector<ExactSphere>& spheres)
{
    openvdb::CoordBBox box = boundingBox(spheres, metricOf(tree));
    const int flat = tree.flatAxis;
    if (tree.settings.dim == 2) box.min()[flat] = box.max()[flat] = tree.object.bbox.min()[flat];
    return box;
}

openvdb::MaskTree::Ptr levelUnion(const SphereTree& tree, const SphereTreeLevel& level,
    openvdb::util::NullInterrupter* interrupter)
{
    const std::vector<ExactSphere> spheres = levelSpheres(tree, level);
    const openvdb::CoordBBox box = levelBox(tree, spheres);
    if (crossedRows(spheres, box, metricOf(tree)) > double(kMaxUnionRows)) {
        OPENVDB_THROW(openvdb::ValueError,
            "the spheres of level " << level.level << " reach over " << box.extents()
                                    << " voxels, more than are drawn: choose a finer level");
    }
    return sphereUnion(spheres, box, metricOf(tree), interrupter);
}

} // namespace openvdb_spheretree
