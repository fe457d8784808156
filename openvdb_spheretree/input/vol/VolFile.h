// SPDX-License-Identifier: Apache-2.0
/// @file VolFile.h
/// @brief Reader of the `.vol` (versions 2 and 3) and `.longvol` files of the discrete geometry
/// community (DGtal, VolGallery).
///
/// A text header of `Key: value` lines ends with a line `.`; X*Y*Z values follow, x fastest:
/// unsigned bytes in a `.vol`, unsigned 64-bit little-endian in a `.longvol`; version 2 raw,
/// version 3 as one zlib stream.

#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <string>

namespace openvdb_spheretree {

/// @return whether the name ends with `.vol` or `.longvol`, in any case.
bool isVolFileName(const std::string& path);

/// @brief Read a `.vol` as an Int32Grid, a `.longvol` as an Int64Grid, named after the file. Voxel
/// (x,y,z), counted from the file's first, is index (x,y,z); voxels of value 0 are inactive. The
/// transform is the identity, scaled by the header's `Voxel-Size` if there is one; `Center-*` is
/// ignored. Values of a `.longvol` beyond 2^63 - 1 are stored as 2^63 - 1.
/// @throw openvdb::IoError if the file cannot be read, is truncated, has a damaged stream, or its
///        header is wrong or asks for more (or less) than the file holds; the message names the
///        file and key
/// @throw Interrupted if the interrupter said so
/// @note Memory is that of the result and of sixteen slices of the volume.
openvdb::GridBase::Ptr readVolFile(
    const std::string& path, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
