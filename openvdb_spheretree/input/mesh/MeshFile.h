// SPDX-License-Identifier: Apache-2.0
/// @file MeshFile.h
/// @brief Reads mesh files, and makes level sets of meshes (by OpenVDB's tools::meshToVolume).
///
/// `.obj .off .ply .stl` are read in every build, by strict readers of our own. Other formats
/// (`.gltf .glb .fbx .dae .3ds ...`) are read by assimp, in builds that have it.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/math/Vec3.h>
#include <openvdb/util/NullInterrupter.h>

#include <string>
#include <vector>

namespace openvdb_spheretree {

/// Triangles in world space.
struct TriangleMesh {
    std::string name;
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
};

/// @return whether this build reads more than `.obj .off .ply .stl`, because it has assimp.
bool readsOtherMeshFormats();

/// @return whether the extension is that of a mesh file. Builds without assimp also know its most
/// common formats, so that readMeshFile() can say what is missing.
bool isMeshFileName(const std::string& path);

/// @brief Read every mesh of a file as one set of triangles, named after the file.
///
/// Transforms of the file's scene are applied. Polygons are cut into triangles; points and lines are
/// ignored. Equal points are joined, and points of no triangle dropped.
/// @param shownAs  in place of @a path, what messages and the mesh are named after, and whose
///                 extension says the format, of those that are read in every build: for files
///                 without a name of their own
/// @throw openvdb::IoError if the file cannot be read, is damaged, or holds no triangle; the
///        message names the file. (An OBJ does not say how much it holds: one cut between two lines
///        is read as the smaller mesh that it is.)
TriangleMesh readMeshFile(const std::string& path, const std::string& shownAs = {});

/// @return how many edges belong to an odd number of triangles. If any do, the mesh has a hole or a
/// fin, and its inside is not well defined. Cost: sorting the edges.
int64_t openEdges(const TriangleMesh& mesh);

/// @brief Narrow-band level set of @a mesh.
/// @param voxelSize   world units, > 0
/// @param halfWidth   of the narrow band, in voxels, 1 to 1000
/// @throw openvdb::ValueError if an argument is out of range, or the mesh empty, damaged, or too
///        large for the voxel size, or for this machine's memory: by the area of its triangles
/// @throw Interrupted if the interrupter said so
openvdb::SharedPtr<openvdb::FloatGrid> meshToLevelSet(const TriangleMesh& mesh, double voxelSize,
    double halfWidth = 3, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return the voxel size for which the longest side of the mesh's box is @a dim voxels.
/// @throw openvdb::ValueError if @a dim < 1, or the mesh is empty, a single place, or not finite
double voxelSizeForDim(const TriangleMesh& mesh, int dim);

} // namespace openvdb_spheretree
