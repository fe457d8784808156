// SPDX-License-Identifier: Apache-2.0
#include "SphereLevelSet.h"

#include <openvdb_spheretree/base/Interrupted.h>

#include <openvdb/tools/ParticlesToLevelSet.h>

#include <cmath>

namespace openvdb_spheretree {
namespace {

/// The stored spheres of a level, as OpenVDB's rasterizer takes them.
struct StoredSpheres {
    using PosType = openvdb::Vec3R;
    const SphereTree& tree;
    const SphereTreeLevel& level;

    size_t size() const { return size_t(level.size()); }
    void getPos(size_t n, openvdb::Vec3R& xyz) const
    {
        xyz = tree.centerWorld(level.begin + int32_t(n));
    }
    void getPosRad(size_t n, openvdb::Vec3R& xyz, openvdb::Real& radius) const
    {
        getPos(n, xyz);
        radius = tree.spheres.radiusWorld[size_t(level.begin) + n];
    }
};

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
    if (!voxelSize) grid->setTransform(tree.transform->copy());
    openvdb::util::NullInterrupter silent;
    openvdb::tools::ParticlesToLevelSet<openvdb::FloatGrid, void, openvdb::util::NullInterrupter>
        raster(*grid, interrupter ? interrupter : &silent);
    raster.setRmax(1e15); // by default it leaves out small and large spheres
    raster.setRmin(0);
    raster.rasterizeSpheres(StoredSpheres{tree, level});
    if (openvdb::util::wasInterrupted(interrupter)) throw Interrupted();
    raster.finalize(/*prune=*/true);
    return grid;
}

} // namespace openvdb_spheretree
