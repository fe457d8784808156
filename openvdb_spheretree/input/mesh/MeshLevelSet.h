// SPDX-License-Identifier: Apache-2.0
/// @file MeshLevelSet.h
/// @brief Makes level sets of meshes, by OpenVDB's tools::meshToVolume.

#pragma once

#include <openvdb_spheretree/mesh/TriangleMesh.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {

/// @brief Narrow-band level set of @a mesh.
/// @param voxelSize   world units, > 0
/// @param halfWidth   of the narrow band, in voxels, 1 to 1000
/// @throw openvdb::ValueError if an argument is out of range, or the mesh empty, damaged, or too
///        large for the voxel size, or for this machine's memory: by the area of its triangles
/// @throw Interrupted if the interrupter said so
openvdb::SharedPtr<openvdb::FloatGrid> meshToLevelSet(const TriangleMesh& mesh, double voxelSize,
    double halfWidth = 3, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
