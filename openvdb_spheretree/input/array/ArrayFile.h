// SPDX-License-Identifier: Apache-2.0
/// @file ArrayFile.h
/// @brief What readers of volumes share: they take a regular file, their messages name it, and voxels
/// have a place in world space.

#pragma once

#include <openvdb/openvdb.h>

#include <cstdint>
#include <fstream>
#include <functional>
#include <string>

namespace openvdb_spheretree::detail {

/// @param bytes  of the file, which is open at its start
using ReadArray = std::function<openvdb::GridBase::Ptr(std::ifstream& file, uint64_t bytes)>;

/// @return what @a read makes of the file.
/// @param name  what messages call the file
/// @throw openvdb::IoError that begins with the name, for what @a read throws without, if it is no
///        regular file, or there is not enough memory
openvdb::GridBase::Ptr readArrayFile(
    const std::string& path, const std::string& name, const ReadArray& read);

/// @return the transform whose voxels have these sides along x, y, z.
/// @throw openvdb::IoError without the name of a file, if OpenVDB has none that small
openvdb::math::Transform::Ptr transformOf(const openvdb::Vec3d& voxelSize);

/// @return the transform that takes index space to world by a matrix for row vectors.
/// @throw openvdb::IoError without the name of a file, if it is not finite, flat, or too small
openvdb::math::Transform::Ptr transformOf(const openvdb::Mat4d& indexToWorld);

} // namespace openvdb_spheretree::detail
