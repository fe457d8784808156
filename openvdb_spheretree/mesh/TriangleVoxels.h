// SPDX-License-Identifier: Apache-2.0
/// @file TriangleVoxels.h
/// @brief The voxels that triangles meet: those of whose closed cubes they share a point with.
///
/// A triangle and a box are apart exactly if one of thirteen directions separates them: the three axes,
/// the triangle's normal, and the cross products of its edges with the axes (S. Gottschalk, M. Lin,
/// D. Manocha, "OBBTree", SIGGRAPH 1996). We ask it as M. Schwarz and H.-P. Seidel do ("Fast Parallel
/// Surface and Solid Voxelization on GPUs", SIGGRAPH Asia 2010, section 3): the nine cross products are
/// the edges of the triangle's projections along the axes, and for boxes of one size every question is
/// a linear function of the box's corner.
///
/// Rounding never loses a voxel: each function has a bound of what rounding can do to it, and is taken as
/// it suits the voxel. So a voxel may be added that a triangle misses by some 2^-45 of its coordinates; by more
/// where an edge is much shorter than these, as its direction is then less certain.
///
/// 1. `TriangleBoxTest`: the linear functions of a triangle, for boxes of 1, 2, 4, ... voxels a side.
/// 2. `Piece`: triangles as they are, and large ones cut along the nodes of 128^3 voxels that they meet.
/// 3. Each piece goes down from the smallest box around it to the voxels, eight children at a time.
///
/// Cost: O(triangles + voxels met); the tests of a large triangle are a few a voxel. Parallel.
/// Tests: TestTriangleVoxels.cc, against separating axes in integers.

#pragma once

#include "TriangleMesh.h"
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <array>
#include <vector>

namespace openvdb_spheretree {

/// Triangles in index space.
struct IndexMesh {
    std::vector<openvdb::Vec3d> points;
    std::vector<openvdb::Vec3I> triangles;
    /// The coordinates may be off by so much, voxels: from rounding on the way to index space.
    double pointError = 0;
};

/// @return @a mesh in the index space of @a transform.
IndexMesh toIndexSpace(const TriangleMesh& mesh, const openvdb::math::Transform& transform);

/// @return whether a triangle meets the closed cube of a voxel; its corners are in index space.
bool meetsVoxel(const openvdb::Vec3d& a, const openvdb::Vec3d& b, const openvdb::Vec3d& c,
    const openvdb::Coord& voxel);

/// @return the voxels whose closed cubes, of half a voxel to each side of their center, a triangle meets.
/// @param mesh         its corners must be there, and within 2^29 voxels (requireUsableMesh())
/// @param interrupter  may be null; asked from many threads
/// @throw Interrupted if the interrupter said so
/// @note The same for any number of threads.
openvdb::SharedPtr<openvdb::MaskTree> trianglesToVoxels(
    const IndexMesh& mesh, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
