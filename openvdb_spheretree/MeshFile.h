// SPDX-License-Identifier: Apache-2.0
/// @file MeshFile.h
/// @brief Reader of mesh files (by assimp), and mesh to level set (by OpenVDB's tools::meshToVolume).

#pragma once

#include <openvdb/openvdb.h>
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

/// @return whether this build reads meshes: it was configured with assimp.
bool hasMeshReader();

/// @return whether the reader knows files with this name's extension.
bool isMeshFileName(const std::string& path);

/// @brief Read every mesh of a file, placed by its scene's transforms, as one set of triangles.
/// @throw openvdb::IoError if the file cannot be read, is damaged, or holds no triangle; the message
///        names the file
TriangleMesh readMeshFile(const std::string& path);

/// @brief Narrow-band level set of @a mesh.
/// @param voxelSize   world units, > 0
/// @param halfWidth   of the narrow band, in voxels, >= 1
/// @throw openvdb::ValueError if an argument is out of range or the mesh is empty
/// @throw Interrupted if the interrupter said so
openvdb::FloatGrid::Ptr meshToLevelSet(const TriangleMesh& mesh, double voxelSize,
    double halfWidth = 3, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return the voxel size for which the longest side of the mesh's box is @a dim voxels.
double voxelSizeForDim(const TriangleMesh& mesh, int dim);

} // namespace openvdb_spheretree
