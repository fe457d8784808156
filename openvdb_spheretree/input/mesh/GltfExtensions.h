// SPDX-License-Identifier: Apache-2.0
/// @file GltfExtensions.h
/// @brief What a glTF scene requires of its readers (glTF 2.0, section 3.12: one that does not know an extension that is
/// required must not show the scene; assimp reads it all the same, with other points or too few).

#pragma once

#include <string>

namespace openvdb_spheretree::detail {

/// @param path  of a `.gltf` or `.glb`; damage is not found here, but by who reads it whole
/// @throw openvdb::IoError if the scene requires an extension that may say which triangles there are: all but those
///        of looks, lights and texts
void requireKnownExtensions(const std::string& path);

} // namespace openvdb_spheretree::detail
