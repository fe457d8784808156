// SPDX-License-Identifier: Apache-2.0
/// @file MeshCheck.h
/// @brief Proves that the stored spheres of a tree cover a mesh: every point of every triangle, on every level.
///
/// A triangle is divided along its longest edge, over and over, until each piece
/// - has its three corners in one stored sphere, which is convex, and so holds the piece, or
/// - lies in voxel cubes of the object, where padding=cubes has every level cover these. (That they do is what
///   checkSphereTree() finds out.)
/// A piece that no sphere and no such cube comes near is uncovered, and so is one of less than 1/64 voxel for
/// which neither was found. So "covered" is a proof, but for the rounding of the corners' coordinates; "not
/// covered" may be a hair's breadth.
///
/// With an object of all voxels that meet the solid (meshToObject()) every piece lies in its cubes: then the
/// inside of the mesh is covered, too, since it is the object's.
///
/// Cost: O(triangles + voxels of the surface) where the object's cubes hold all of it; else, for what they do
/// not hold, up to 10^4 pieces for each voxel that the border of what is covered runs through. Parallel.
/// Tests: TestMeshCheck.cc.

#pragma once

#include "TreeCheck.h"
#include <openvdb_spheretree/mesh/TriangleMesh.h>

namespace openvdb_spheretree {

/// @param object  that the tree was built from, or null if it is not known: spheres must cover the mesh by
///                themselves then
/// @return a fault (FaultKind::Surface) for each level that leaves some of the mesh uncovered, with how much and
///         where; none if every level covers all of it
/// @throw openvdb::ValueError if the mesh is damaged, or the tree is one of spheres inside the object or of a norm
///        (dist=) other than the Euclidean: these do not cover it
/// @throw Interrupted if the interrupter (may be null) said so
std::vector<TreeFault> checkMeshCovered(const SphereTree& tree, const TriangleMesh& mesh,
    const openvdb::BoolGrid* object, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief All that can be found out with what is there: checkSphereTree() first, for cubes of the
/// object count as covered where it finds nothing, then checkMeshCovered().
/// @param object,mesh  null where there is none
/// @throw as both
std::vector<TreeFault> checkAgainst(const SphereTree& tree, const openvdb::BoolGrid* object,
    const TriangleMesh* mesh, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
