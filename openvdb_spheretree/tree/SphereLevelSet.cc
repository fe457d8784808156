// SPDX-License-Identifier: Apache-2.0
#include "SphereLevelSet.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/voxel/GridTemplates.h> // compiles in half the time
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/math/Math.h>
#include <openvdb/tools/ParticlesToLevelSet.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace openvdb_spheretree {
namespace {

/// The stored spheres of a level, as OpenVDB's rasterizer takes them.
struct StoredSpheres {
    using PosType = openvdb::Vec3R;
    const SphereTree& tree;
    const SphereTreeLevel& level;
    double indexScale = 0; ///< where they are: in index space times this; 0: in the world

    size_t size() const { return size_t(level.size()); }
    void getPos(size_t n, openvdb::Vec3R& xyz) const
    {
        const int32_t id = level.begin + int32_t(n);
        xyz = indexScale > 0 ? tree.spheres.center[size_t(id)] * indexScale : tree.centerWorld(id);
    }
    void getPosRad(size_t n, openvdb::Vec3R& xyz, openvdb::Real& radius) const
    {
        getPos(n, xyz);
        radius = tree.spheres.radiusWorld[size_t(level.begin) + n];
    }
};

/// What the rasterizer will write: every voxel in a sphere or its band, once for each sphere that
/// it is in; and no more than the box of all of them has.
class LevelSetSize {
public:
    explicit LevelSetSize(const openvdb::math::Transform& transform, double halfWidth)
        : mTransform(transform), mVoxel(voxelSizeOf(transform)), mHalfWidth(halfWidth)
    {}

    void add(const openvdb::Vec3d& world, double radiusWorld)
    {
        const double reach = radiusWorld / mVoxel + mHalfWidth + 1;
        const openvdb::Vec3d center = mTransform.worldToIndex(world);
        mBox.expand(center - openvdb::Vec3d(reach));
        mBox.expand(center + openvdb::Vec3d(reach));
        mVoxels += 4.0 / 3.0 * openvdb::math::pi<double>() * reach * reach * reach;
    }

    double voxels() const
    {
        const openvdb::Vec3d side = mBox.max() - mBox.min();
        return std::min(mVoxels, side[0] * side[1] * side[2]);
    }

    /// @return how far from voxel 0 it reaches along an axis, in voxels.
    double farthest() const
    {
        double far = 0;
        for (int axis = 0; axis < 3; ++axis) {
            far = std::max({far, -mBox.min()[axis], mBox.max()[axis]});
        }
        return far;
    }

private:
    const openvdb::math::Transform& mTransform;
    double mVoxel, mHalfWidth, mVoxels = 0;
    openvdb::BBoxd mBox;
};

/// @throw openvdb::ValueError with the number of voxels, before any is made
void requireRoom(const StoredSpheres& spheres, const openvdb::FloatGrid& grid, double halfWidth)
{
    LevelSetSize size(grid.transform(), halfWidth);
    for (std::size_t n = 0; n < spheres.size(); ++n) {
        openvdb::Vec3R center;
        openvdb::Real radius;
        spheres.getPosRad(n, center, radius);
        size.add(center, radius);
    }
    const std::string what = "the level set of level " + std::to_string(spheres.level.level)
        + " with voxels of " + std::to_string(grid.voxelSize()[0]);
    constexpr double kFarthest = double(int64_t(1) << 30); // as of meshes
    if (!(size.farthest() <= kFarthest)) {
        OPENVDB_THROW(openvdb::ValueError,
            what << " would reach voxel " << size.farthest()
                 << ", beyond 2^30: use a larger voxel, or move the object towards the origin");
    }
    if (size.voxels() <= double(kMaxLevelSetVoxels)) return;
    OPENVDB_THROW(openvdb::ValueError,
        what << " may take " << size.voxels() << " voxels inside and near its " << spheres.size()
             << " spheres, and " << kMaxLevelSetVoxels
             << " is the most: use a larger voxel, a narrower band or a finer level");
}

} // namespace

openvdb::SharedPtr<openvdb::FloatGrid> levelSetOfSpheres(const SphereTree& tree,
    const SphereTreeLevel& level, std::optional<double> voxelSize, double halfWidth,
    openvdb::util::NullInterrupter* interrupter)
{
    if (!tree.settings.dist().isEuclidean()) {
        OPENVDB_THROW(openvdb::ValueError,
            "the balls of dist=" << toString(tree.settings.dist())
                                 << " are no spheres and make no level set: take levelUnion()");
    }
    if (!voxelSize && !hasCubicVoxels(*tree.transform)) {
        OPENVDB_THROW(openvdb::ValueError,
            "the tree's transform has been changed, and its voxels are no cubes: choose a voxel "
            "size");
    }
    constexpr double kSmallestVoxel = 2e-5; // OpenVDB's own limit is at 1.4e-5
    if (voxelSize && !(*voxelSize >= kSmallestVoxel && std::isfinite(*voxelSize))) {
        OPENVDB_THROW(openvdb::ValueError,
            "voxel size " << *voxelSize << " is out of range; it must be a finite number, "
                          << kSmallestVoxel << " or more");
    }
    if (!(halfWidth >= 1 && halfWidth <= 1000)) {
        OPENVDB_THROW(openvdb::ValueError,
            "half width " << halfWidth << " is out of range; it must be from 1 to 1000 voxels");
    }
    const double voxel = voxelSize.value_or(tree.voxelSize());
    auto grid = openvdb::createLevelSet<openvdb::FloatGrid>(voxel, halfWidth);
    // With the tree's own voxels, its spheres are those of index space: the rasterizer takes small or
    // large voxels that are turned for no cubes (UniformVoxels.h), and for others than they are where
    // they are far away.
    const StoredSpheres spheres{tree, level, voxelSize ? 0 : voxel};
    requireRoom(spheres, *grid, halfWidth);
    openvdb::util::NullInterrupter silent;
    openvdb::tools::ParticlesToLevelSet<openvdb::FloatGrid, void, openvdb::util::NullInterrupter>
        raster(*grid, interrupter ? interrupter : &silent);
    raster.setRmax(1e15); // by default it leaves out small and large spheres
    raster.setRmin(0);
    raster.rasterizeSpheres(spheres);
    if (openvdb::util::wasInterrupted(interrupter)) throw Interrupted();
    raster.finalize(/*prune=*/true);
    if (!voxelSize) grid->setTransform(tree.transform->copy());
    return grid;
}

} // namespace openvdb_spheretree
