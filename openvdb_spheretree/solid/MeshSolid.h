// SPDX-License-Identifier: Apache-2.0
/// @file MeshSolid.h
/// @brief The voxels of the solid that a mesh bounds: all whose cubes meet it, thin parts too.
///
/// 1. The *surface* is every voxel that a triangle meets (TriangleVoxels.h). No path of voxels that share
///    faces gets through it: where the segment between two centers crosses a triangle, one of the two voxels
///    is of the surface.
/// 2. So what a path from infinity cannot reach is inside: the cavities of the surface, filled.
///
/// How triangles face, how often they overlap, and what they bound inside of others makes no difference to it.
/// Where a mesh is open by more than a voxel there is no inside; its surface is the solid then.
///
/// With a *gap*, the surface is first dilated by a ball of radius r = gap / 2 + 1 / 2 + sqrt(3) / 2 voxels or
/// somewhat more, and the solid eroded by the same ball at last. Holes of such a width are closed, and so are
/// narrower crevices and dents: a path of voxels through a hole has a step across it, at a point within gap / 2
/// of the mesh. One of the two centers is within 1 / 2 of that point, and the center of a surface voxel within
/// sqrt(3) / 2 of the mesh there.
///
/// Voxels that are *wholly* inside have to be so of the mesh itself. A room whose neck is narrower than a voxel
/// is kept from outside by the surface, but the mesh does not wind around it; it is no part of the solid then
/// (WindingNumber.h), and neither is a hollow whose surface faces it.
///
/// Cost: O(triangles + voxels of the surface), and leaf-sized tiles inside; with a gap, the voxels within 4 r
/// of the surface. Parallel. Tests: TestMeshSolid.cc.

#pragma once

#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/mesh/TriangleMesh.h>

#include <openvdb/util/NullInterrupter.h>

#include <string>

namespace openvdb_spheretree {

struct MeshSolidSettings {
    /// Cubes: every voxel whose closed cube meets the solid. Whole: those that the mesh winds around, and whose
    /// cubes no triangle meets. (Centers: by meshToLevelSet().)
    Coverage coverage = Coverage::Cubes;
    /// Width of holes that are closed, world units: 0 (those below a voxel) to 125 voxels.
    double gap = 0;
};

/// @brief The object of a mesh's solid, named after the mesh.
/// @param voxelSize  world units, > 0; voxel (0, 0, 0) has its center at the world's origin
/// @throw openvdb::ValueError if an argument is out of range, or the mesh empty, damaged, or too large for the voxel
///        size, or for this machine's memory; or if no voxel lies wholly inside, and such are asked for
/// @throw Interrupted if the interrupter (may be null) said so
openvdb::SharedPtr<openvdb::BoolGrid> meshToObject(const TriangleMesh& mesh, double voxelSize,
    const MeshSolidSettings& settings = {}, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief How much of a mesh has nothing inside: the share of its area, 0 to 1, of which neither side is in the
/// object, two voxels away. Of a solid that is thicker than that it is 0, or nearly so; of a sheet, or of a
/// mesh that is open too wide to have an inside, it is large.
/// @note Some thousand points of the mesh are looked at. Cost: O(triangles).
double hollowShare(const TriangleMesh& mesh, const openvdb::BoolGrid& object);

/// @brief Whether the object of an open mesh, whose holes were to be closed, has something inside.
/// @param gap  that they were closed with
/// @return a sentence for people if it has not, because a quarter of the mesh has nothing inside (hollowShare()), or
///         because a twentieth of the volume is missing that the mesh has once its holes are closed (MeshHoles.h);
///         empty if it has, or if the mesh is closed
std::string hollowWarning(const TriangleMesh& mesh, const openvdb::BoolGrid& object, double gap,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// What an object lacks of a mesh.
struct MissedSurface {
    int64_t voxels =
        0; ///< that triangles meet, more than one voxel away from the object's, diagonally too
    double distance = 0; ///< of the furthest of these from the object, between centers, world units
};

/// @return what @a object lacks of @a mesh: thin parts, for instance, that hold no voxel's center.
/// @param object  not empty
/// Cost: that of the surface's voxels, and a search for the nearest voxel for those that are missed.
MissedSurface missedSurface(const TriangleMesh& mesh, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
