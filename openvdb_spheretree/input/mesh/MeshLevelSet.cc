// SPDX-License-Identifier: Apache-2.0
#include "MeshLevelSet.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/TextStream.h>

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <string>
#include <vector>

namespace openvdb_spheretree {

namespace {

using openvdb::Vec3d;
using openvdb::Vec3I;
using openvdb::Vec3s;

constexpr double kMaxHalfWidth = 1000; // wider is a slip: memory grows with its cube

/// @return the center of the mesh's box in index space, rounded to a leaf's corner. Around it,
/// floats are exact to a small part of a voxel.
openvdb::Coord middleLeaf(const TriangleMesh& mesh, double voxelSize)
{
    return openvdb::Coord::floor(boxOf(mesh).getCenter() / voxelSize)
        & ~int32_t(openvdb::FloatTree::LeafNodeType::DIM - 1);
}

/// Moves the narrow band by @a shift, a multiple of leaves, and fills its inside again.
void moveBand(openvdb::FloatGrid& grid, const openvdb::Coord& shift)
{
    if (shift == openvdb::Coord()) return;
    std::vector<openvdb::FloatTree::LeafNodeType*> leaves;
    grid.tree().stealNodes(leaves);
    grid.tree().clear();
    for (auto* leaf : leaves) {
        leaf->setOrigin(leaf->origin() + shift);
        grid.tree().addLeaf(leaf);
    }
    openvdb::tools::signedFloodFill(grid.tree());
}

/// By the area of its triangles a mesh has a narrow band of so many voxels, and fewer where triangles
/// are nearer to each other than twice its half width; by its box it cannot have more. Measured are 35
/// bytes a voxel of the band: what is refused needs more than there is even if four triangles share one.
/// However small the mesh is, the band holds the ball of the half width around each of its points.
void requireRoomForBand(const TriangleMesh& mesh, double voxelSize, double halfWidth)
{
    constexpr double kBytes = 8, kBytesOfDense = 8;
    constexpr double kOfCube = 4.18879; // the volume of a ball, of its radius' cube
    const Vec3d sides = boxOf(mesh).extents() / voxelSize + Vec3d(2 * halfWidth);
    const double ball = kOfCube * halfWidth * halfWidth * halfWidth;
    const double band = std::max(2 * halfWidth * areaOf(mesh) / (voxelSize * voxelSize), ball);
    const double bytes = std::min(kBytes * band, kBytesOfDense * sides[0] * sides[1] * sides[2]);
    detail::TextStream what;
    what << "the up to " << std::setprecision(2) << band << " voxels at the surface of mesh '"
         << mesh.name << "'";
    detail::requireMemory(bytes, what.str(), "use a larger voxel, or a narrower band");
}

} // namespace

openvdb::FloatGrid::Ptr meshToLevelSet(const TriangleMesh& mesh, double voxelSize, double halfWidth,
    openvdb::util::NullInterrupter* interrupter)
{
    const openvdb::math::Transform::Ptr transform = transformOfVoxels(voxelSize);
    if (!(halfWidth >= 1 && halfWidth <= kMaxHalfWidth)) {
        OPENVDB_THROW(openvdb::ValueError,
            "half width " << halfWidth << " is out of range; it must be from 1 to " << kMaxHalfWidth
                          << " voxels");
    }
    requireUsableMesh(mesh, voxelSize);
    requireRoomForBand(mesh, voxelSize, halfWidth);
    const openvdb::Coord shift = middleLeaf(mesh, voxelSize);
    std::vector<Vec3s> points; // in index space, around the origin
    points.reserve(mesh.points.size());
    for (const Vec3d& world : mesh.points) {
        points.emplace_back(world / voxelSize - shift.asVec3d());
    }
    // The types for which the code is in OpenVDB's library.
    const openvdb::tools::QuadAndTriangleDataAdapter<Vec3s, Vec3I> adapter(points, mesh.triangles);
    openvdb::util::NullInterrupter silent;
    openvdb::util::NullInterrupter& boss = interrupter ? *interrupter : silent;
    const auto band = static_cast<float>(halfWidth);
    auto grid =
        openvdb::tools::meshToVolume<openvdb::FloatGrid>(boss, adapter, *transform, band, band);
    if (openvdb::util::wasInterrupted(&boss)) throw Interrupted();
    moveBand(*grid, shift);
    grid->setName(mesh.name);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    return grid;
}

} // namespace openvdb_spheretree
