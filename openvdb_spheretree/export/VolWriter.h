// SPDX-License-Identifier: Apache-2.0
/// @file export/VolWriter.h
/// @brief An object as a `.vol` file of the discrete geometry community (DGtal, VolGallery).

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <iosfwd>

namespace openvdb_spheretree {

/// @brief Write the box of an object's voxels: 255 where there is one, else 0; x fastest, as one zlib stream
/// (version 3 of the format; VolFile.h reads it). `Voxel-Size` has the sides of a voxel. The format has no
/// room for where the box is, nor for a turn: the first voxel written is that with the lowest coordinates.
///
/// Memory: one slice of the box. Cost: a pass over the box, whatever is in it.
/// @throw openvdb::ValueError if the object is empty, or its box is longer than 2^20 voxels or has more than
///        2^40; openvdb::IoError if the stream fails
/// @throw Interrupted
void writeVolFile(const openvdb::BoolGrid& object, std::ostream& out,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
