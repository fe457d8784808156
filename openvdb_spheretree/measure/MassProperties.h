// SPDX-License-Identifier: Apache-2.0
/// @file MassProperties.h
/// @brief Volume, center of mass and inertia of an object, and of the union of a level's spheres: exact
/// in voxels.
///
/// Voxels are solid cubes of density 1. Sums over voxels are integers (VoxelMoments.h), and so is the
/// shift to the center of mass but for its last part; then come doubles, and the grid's transform.
/// A body far from the origin loses nothing by it.
///
/// 1. count N, sums S_a and S_ab of the coordinates of voxel centers and of their products;
/// 2. about their mean: S_ab - S_a S_b / N, and N / 12 where a = b for the cubes themselves;
/// 3. J C J^T |det J| of that matrix C, where J takes steps of index space to world space;
/// 4. inertia: the trace of that times the unit matrix, less that.
///
/// In 2-D an object is what it is in 3-D: a plate of one voxel's thickness.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/Types.h>
#include <openvdb/math/Mat3.h>
#include <openvdb/util/NullInterrupter.h>

#include <optional>

namespace openvdb_spheretree {

/// Of a body of density 1, in world units and axes. Of another density, multiply the volume and the
/// inertia by it.
struct MassProperties {
    double volume = 0;                               ///< world units^3; the mass
    openvdb::Vec3d center{0, 0, 0};                  ///< of mass, world space
    openvdb::Mat3d inertia = openvdb::Mat3d::zero(); ///< about the center, world units^5; symmetric
    openvdb::Vec3d principalMoments{0, 0, 0};        ///< the eigenvalues of the inertia, ascending
    /// A row is the unit vector, in world space, of a principal moment. Right-handed. The largest
    /// coordinate of the first two is positive. Where moments are equal, vectors are any that fit,
    /// and the axes of the world if these do.
    openvdb::Mat3d principalAxes = openvdb::Mat3d::identity();
};

/// @return those of the active voxels as cubes; nothing if there are none. Voxels need not be cubes
///         in world space: boxes, turned, mirrored and sheared ones are as exact.
/// @throw openvdb::ValueError if the transform is no linear one (a frustum)
/// @throw Interrupted
/// @note Cost: linear in leaf nodes; tiles are never expanded. Parallel; the result does not depend
///       on threads. Thread-safe.
std::optional<MassProperties> massProperties(
    const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return the same of voxels of a mask.
std::optional<MassProperties> massProperties(const openvdb::MaskTree& voxels,
    const openvdb::math::Transform& transform,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return those of the union of a level's spheres as they are stored, with padding and all: of the
///         voxels whose centers lie in them. What spheres have in common counts once. Nothing if the
///         spheres hold no voxel center, as those of inner trees and of other tools may.
/// @param tree  has its stored radii and its transform, as all that are built or read
/// @throw openvdb::ValueError if the spheres cross more than kMaxUnionRows rows of voxels (a top
///        level far larger than its object): choose a finer level
/// @note Cost: that of sphereUnion().
std::optional<MassProperties> massProperties(const SphereTree& tree, const SphereTreeLevel& level,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
