// SPDX-License-Identifier: Apache-2.0
/// @file VolFile.h
/// @brief Reader of the `.vol` (versions 2 and 3) and `.longvol` files of the discrete geometry
/// community (DGtal, VolGallery).
///
/// A text header of lines `Key: value` ends with a line `.`. X*Y*Z values follow, x fastest:
/// unsigned bytes in a `.vol`, unsigned 64-bit little-endian integers in a `.longvol`. They are raw
/// in version 2, and one zlib stream in version 3.

#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <string>

namespace openvdb_spheretree {

/// @return whether the name ends with `.vol` or `.longvol`, in any case.
bool isVolFileName(const std::string& path);

/// @brief Read a `.vol` as an Int32Grid, or a `.longvol` as an Int64Grid, named after the file.
///
/// The first voxel has the index (0,0,0). Voxels of value 0 are inactive. The transform is the
/// identity, scaled by the header's `Voxel-Size` if there is one: a number, or three along x, y, z
/// (objectOf() wants cubes: see resampled()). `Center-*` is ignored. Values of a `.longvol` beyond
/// 2^63 - 1 are stored as 2^63 - 1. Memory: the result, and sixteen slices of the volume.
/// @param shownAs  in place of @a path, what messages and the grid are named after, and whose
///                 extension says the format: for files without a name of their own
/// @throw openvdb::IoError if the file cannot be read, is truncated or damaged, or if its header is
///        wrong or asks for more or less than the file holds. The message names the file and key.
/// @throw Interrupted if the interrupter said so
openvdb::GridBase::Ptr readVolFile(const std::string& path,
    openvdb::util::NullInterrupter* interrupter = nullptr, const std::string& shownAs = {});

} // namespace openvdb_spheretree
