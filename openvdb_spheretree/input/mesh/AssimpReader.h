// SPDX-License-Identifier: Apache-2.0
/// @file AssimpReader.h
/// @brief Polygons of the mesh formats that have no reader here, by assimp, in builds that have it.

#pragma once

#include "MeshFormats.h"

#include <openvdb/util/NullInterrupter.h>

#include <string>

namespace openvdb_spheretree::detail {

bool hasAssimp();

/// @param extension  with its dot, in small letters
/// @return whether it is one of assimp's; without assimp, one of its most common ones.
bool assimpKnows(const std::string& extension);

/// @brief All meshes of the file's scene, each placed by the transforms of its nodes.
///
/// Files of strangers make assimp crash, or ask for all memory, in more ways than can be foreseen (counts below zero,
/// strides beyond arrays, nodes within themselves, nesting deeper than a stack). So it runs in a child process, with as
/// much memory and time as its files allow (kBeginning). What it reads from elsewhere (the buffers of a `.gltf`) must be
/// regular files in the file's folder, or below it.
/// @throw openvdb::IoError without the name of the file: it cannot be read, is damaged, or names files that it may not,
/// or one of them was written to meanwhile
/// @throw Interrupted if the interrupter, which may be null, said so
PolygonSoup readByAssimp(const std::string& path, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
