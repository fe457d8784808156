// SPDX-License-Identifier: Apache-2.0
/// @file GltfExtensions.h
/// @brief What a glTF scene requires of its readers. One that does not know a required extension must not show the scene
/// (glTF 2.0, section 3.12); assimp does, with other triangles.

#pragma once

#include <string>

namespace openvdb_spheretree::detail {

/// @param path  of a `.gltf` or `.glb`; what else is damaged in it is found by who reads it whole
/// @throw openvdb::IoError if the scene's text is no JSON, or if it requires an extension that may say which triangles there
///        are: all but those of looks, lights and texts
void requireKnownExtensions(const std::string& path);

} // namespace openvdb_spheretree::detail
