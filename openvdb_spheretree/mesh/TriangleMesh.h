// SPDX-License-Identifier: Apache-2.0
/// @file TriangleMesh.h
/// @brief Triangles in world space, and what can be said of them before they become voxels.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/math/BBox.h>
#include <openvdb/math/Vec3.h>
#include <openvdb/util/NullInterrupter.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace openvdb_spheretree {

/// The largest coordinate of a mesh: products of several are doubles.
constexpr double kFarthestPoint = 3.4e38;

/// @return whether a mesh may have this coordinate: it is finite, and not beyond kFarthestPoint.
inline bool isMeshCoordinate(double x) { return std::abs(x) <= kFarthestPoint; } // NaN is none
/// @return whether each coordinate is one.
inline bool isMeshPoint(const openvdb::Vec3d& p)
{
    return isMeshCoordinate(p[0]) && isMeshCoordinate(p[1]) && isMeshCoordinate(p[2]);
}

/// Triangles in world space.
struct TriangleMesh {
    std::string name;
    std::vector<openvdb::Vec3d> points; ///< isMeshPoint()
    std::vector<openvdb::Vec3I> triangles;
};

/// @return how many edges belong to an odd number of triangles. If any do, the mesh has a hole or a
/// fin, and its inside is not well defined. Cost: sorting the edges.
int64_t openEdges(const TriangleMesh& mesh, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return the voxel size for which the longest side of the mesh's box is @a dim voxels.
/// @throw openvdb::ValueError if @a dim < 1, or the mesh is empty, a single place, or not finite
double voxelSizeForDim(const TriangleMesh& mesh, int dim);

/// @return a transform of uniform voxels, with the center of voxel (0, 0, 0) at the world's origin.
/// @throw openvdb::ValueError if the size is not finite, not positive, or below 0.0001 or so
openvdb::SharedPtr<openvdb::math::Transform> transformOfVoxels(double voxelSize);

/// @brief See to it that a mesh can become voxels of this size.
/// @throw openvdb::ValueError naming the mesh, if it has no triangles, a triangle has a corner that
///        is not there, or a coordinate is not finite or beyond 2^29 voxels
void requireUsableMesh(const TriangleMesh& mesh, double voxelSize);

/// @return the area of all triangles, world units squared.
double areaOf(const TriangleMesh& mesh);

/// @return the length of the longest edge, world units; 0 of no triangles.
double longestEdge(const TriangleMesh& mesh);

/// @return the box of all points, world units.
openvdb::math::BBox<openvdb::Vec3d> boxOf(const TriangleMesh& mesh);

} // namespace openvdb_spheretree
