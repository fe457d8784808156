// SPDX-License-Identifier: Apache-2.0
/// @file GivenTree.h
/// @brief Spheres that were not built here as a tree of one level, so that all that is done with a
/// level can be done with them: errors, coverage, voxels, level sets, pictures, files.
///
/// *What is exact.* Spheres of others have any center. Here it is rounded to 1/1024 of a voxel of the
/// object's grid, so it moves by 0.00085 voxels at most. Which voxel centers a sphere then holds is
/// decided in integers, as for all trees. The radius is not rounded, but for one part in 10^12,
/// which it grows by: a sphere that ends on a voxel center holds it, whatever rounding in the
/// change from world to voxels did.
///
/// Nodes keep the order of the file: id 0 is its first sphere. None has a parent.

#pragma once

#include "SphereTree.h"
#include <openvdb_spheretree/input/spheres/WorldSpheres.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/math/BBox.h>

namespace openvdb_spheretree {

/// Units in a voxel of the centers of given spheres.
constexpr int kGivenSubdivision = 1024;
/// How far that moves a center at most: half the diagonal of a unit, in voxels, rounded up.
constexpr double kGivenMove = 0.8661 / kGivenSubdivision;

/// @return the box around all, in world units.
openvdb::math::BBox<openvdb::Vec3d> boxOf(const WorldSpheres& spheres);

/// @brief In a frame of their own, where no object is known: voxels are cubes along the axes of the
/// world, a power of two wide, and the longest side of the spheres' box is 128 to 256 of them. `object` has no voxels, and
/// the box of the spheres.
/// @throw openvdb::ValueError if there are no spheres, or one is too far from the others, or too
///        large, for centers and radii of 32 bits; it names the sphere by its id
SphereTree givenTree(const WorldSpheres& spheres);

/// @brief In the frame of an object, which they can then be held against: computeLevelErrors(),
/// checkSphereTree().
/// @param object  its voxels must be cubes
/// @throw openvdb::ValueError as above, or for the object's voxels
SphereTree givenTree(const WorldSpheres& spheres, const openvdb::BoolGrid& object);

/// @return the spheres of level 0 of a tree, or of the only one it has: centers in the world, and
///         radii as they are stored.
WorldSpheres worldSpheres(const SphereTree& tree);

} // namespace openvdb_spheretree
