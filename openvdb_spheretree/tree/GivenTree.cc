// SPDX-License-Identifier: Apache-2.0
#include "GivenTree.h"

#include "LevelSpheres.h"
#include <openvdb_spheretree/base/Rounding.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/Exceptions.h>
#include <openvdb/Grid.h>
#include <openvdb/math/BBox.h>
#include <openvdb/math/Transform.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace openvdb_spheretree {

namespace {

using openvdb::Vec3d;
using openvdb::math::Transform;

/// The square of 1024 times a radius must fit 62 bits, as those of files do.
constexpr double kMaxRadius = double(1 << 21);
/// As far as distances between voxels are measured.
constexpr double kMaxIndex = double(1 << 29);
/// Rounding in the change to voxels is far below it, and so is what a float resolves above it.
constexpr double kGrown = 1 + 1e-12;

/// @return the nearest multiple of 1 / kGivenSubdivision.
Vec3d roundedCenter(const Vec3d& center)
{
    constexpr double kUnits = kGivenSubdivision;
    return {std::round(kUnits * center[0]) / kUnits, std::round(kUnits * center[1]) / kUnits,
        std::round(kUnits * center[2]) / kUnits};
}

void requireInRange(const WorldSpheres& spheres, std::size_t i, const Vec3d& center, double radius)
{
    const double farthest =
        std::max({std::abs(center[0]), std::abs(center[1]), std::abs(center[2])});
    const char* const what = !(radius <= kMaxRadius) ? "too large"
        : !(farthest + radius <= kMaxIndex)          ? "too far away"
                                                     : nullptr;
    if (!what) return;
    OPENVDB_THROW(openvdb::ValueError,
        "sphere " << i << " of '" << spheres.name << "', at " << spheres.center[i]
                  << " with the radius " << spheres.radius[i] << ", is " << what
                  << " for its voxels: radii are at most 2^21 voxels, and coordinates 2^29; are "
                     "both in the same units?");
}

/// @param transform  of cubic voxels
SphereTree treeIn(Transform::Ptr transform, const WorldSpheres& spheres)
{
    if (spheres.size() == 0) OPENVDB_THROW(openvdb::ValueError, "there are no spheres");
    SphereTree tree;
    tree.transform = std::move(transform);
    tree.settings = GivenOptions();
    tree.settings.padding = 0;
    tree.settings.topology = false;
    tree.settings.name = spheres.name;
    tree.subdivision = kGivenSubdivision;
    tree.spheres.reserve(spheres.size());
    const double voxel = tree.voxelSize();
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const Vec3d center = tree.transform->worldToIndex(spheres.center[i]);
        const double radius = spheres.radius[i] / voxel;
        requireInRange(spheres, i, center, radius);
        const double reach = kGivenSubdivision * radius * kGrown;
        tree.spheres.center.push_back(roundedCenter(center));
        tree.spheres.radius.push_back(radius);
        tree.spheres.coverRadiusSq.push_back(int64_t(reach * reach));
        tree.spheres.radiusWorld.push_back(detail::toFloatUp(spheres.radius[i]));
        tree.spheres.parent.push_back(-1);
        tree.ijk.push_back(openvdb::Coord::round(tree.spheres.center.back()));
    }
    tree.radiusSq.assign(spheres.size(), -1);
    tree.levels.resize(1);
    tree.levels.front().end = tree.size();
    return tree;
}

} // namespace

openvdb::BBoxd boxOf(const WorldSpheres& spheres)
{
    openvdb::BBoxd box;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        box.expand(spheres.center[i] - Vec3d(spheres.radius[i]));
        box.expand(spheres.center[i] + Vec3d(spheres.radius[i]));
    }
    return box;
}

SphereTree givenTree(const WorldSpheres& spheres)
{
    constexpr double kVoxels = 256;       // as many as -mesh2ls makes of a mesh
    constexpr double kSmallest = 0x1p-15; // OpenVDB takes a voxel of less than 1.4e-5 for none
    const openvdb::BBoxd box = boxOf(spheres);
    const Vec3d size = spheres.size() ? box.extents() : Vec3d(1);
    const double longest = std::max({size[0], size[1], size[2]});
    if (!(longest < 1e30)) {
        OPENVDB_THROW(openvdb::ValueError,
            "the box of '" << spheres.name << "' has a side of " << longest
                           << ", for which there are no voxels: use other units");
    }
    // A power of two, and a middle in such units: no transform rounds, and none changes in a file.
    const double voxel =
        std::max(kSmallest, std::exp2(std::ceil(std::log2(std::max(longest, 1e-300) / kVoxels))));
    Vec3d middle = spheres.size() ? box.getCenter() / voxel : Vec3d(0);
    constexpr double kFarthest = 0x1p53; // voxels; farther away, no transform keeps them
    const double far = std::max({std::abs(middle[0]), std::abs(middle[1]), std::abs(middle[2])});
    if (far > kFarthest) {
        OPENVDB_THROW(openvdb::ValueError,
            "the spheres of '" << spheres.name << "' are " << far * voxel
                               << " away from the origin, too far for a box of " << longest
                               << ": move them nearer to it, or use other units");
    }
    for (int axis = 0; axis < 3; ++axis) middle[axis] = voxel * std::round(middle[axis]);
    const Transform::Ptr transform = Transform::createLinearTransform(voxel);
    transform->postTranslate(middle);
    SphereTree tree = treeIn(transform, spheres);
    tree.object.name = spheres.name;
    tree.object.bbox = levelBox(tree, levelSpheres(tree, tree.levels.front()));
    if (tree.object.bbox.empty()) tree.object.bbox = openvdb::CoordBBox({0, 0, 0}, {0, 0, 0});
    return tree;
}

SphereTree givenTree(const WorldSpheres& spheres, const openvdb::BoolGrid& object)
{
    requireUniformVoxels(object);
    SphereTree tree = treeIn(object.transform().copy(), spheres);
    tree.object.name = object.getName();
    tree.object.voxels = detail::countVoxels(detail::maskOf(object.tree()));
    tree.object.leaves = int64_t(object.tree().leafCount());
    tree.object.tiles = int64_t(object.tree().activeTileCount());
    tree.object.bbox = object.evalActiveVoxelBoundingBox();
    return tree;
}

WorldSpheres worldSpheres(const SphereTree& tree)
{
    WorldSpheres spheres;
    spheres.name = tree.settings.name;
    const SphereTreeLevel& level = tree.levels.front();
    for (int32_t id = level.begin; id < level.end; ++id) {
        spheres.center.push_back(tree.centerWorld(id));
        spheres.radius.push_back(double(tree.spheres.radiusWorld[id]));
    }
    return spheres;
}

} // namespace openvdb_spheretree
