// SPDX-License-Identifier: Apache-2.0
/// @file MeshFile.h
/// @brief Reads mesh files.
///
/// `.obj .off .ply .stl` are read in every build, by strict readers of our own. Other formats
/// (`.gltf .glb .fbx .dae .3ds ...`) are read by assimp, in builds that have it.

#pragma once

#include <openvdb_spheretree/mesh/TriangleMesh.h>

#include <openvdb/util/NullInterrupter.h>

#include <string>

namespace openvdb_spheretree {

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
/// @throw Interrupted if the interrupter, which may be null, said so
TriangleMesh readMeshFile(const std::string& path, const std::string& shownAs = {},
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
