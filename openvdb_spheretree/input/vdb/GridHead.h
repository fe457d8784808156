// SPDX-License-Identifier: Apache-2.0
/// @file GridHead.h
/// @brief What a `.vdb` has before the nodes of its grids: the file's header, descriptors of grids,
/// metadata, transforms.

#pragma once

#include "ByteWindow.h"
#include "DelayedSizes.h"

#include <cstdint>
#include <optional>
#include <string>

namespace openvdb_spheretree::detail {

/// What becomes of metadata that serves delayed loading alone.
enum class DelayedMetadata {
    Drop, ///< taken out of the bytes: values are read at once, and OpenVDB is spared the parsing
    Keep  ///< parsed
};

struct FileHead {
    uint32_t fileVersion = 0;
    bool hasOffsets = false;  ///< it says where its grids are
    uint32_t compression = 0; ///< of all grids, before version 222
    /// Written by an OpenVDB that copied DelayedSizes without knowing them; the present one does not
    /// heed these.
    bool staleSizes = false;
    int32_t gridCount = 0;
};

/// @brief Walk over the header, the file's metadata and the number of grids.
/// @throw openvdb::IoError if it is no `.vdb`, too old, truncated or damaged
FileHead takeFileHead(ByteWindow& window, DelayedMetadata treatment);

struct GridHead {
    std::string name;         ///< unique in the file
    std::string type;         ///< without the suffix for half precision
    bool instance = false;    ///< it shares the nodes of another grid, and has none here
    bool half = false;        ///< real values are stored in half precision
    uint32_t compression = 0; ///< flags of openvdb::io
    uint64_t begin = 0;       ///< of what follows the descriptor, in bytes from the file's start
    int64_t saidBegin = 0;    ///< the same by the descriptor, if the file has offsets
    int64_t saidEnd = 0;      ///< the end of the grid by the descriptor
    std::optional<DelayedSizes> delayed;
};

/// @brief Walk over a grid's descriptor, its metadata and its transform.
/// @throw openvdb::IoError if the file is truncated or damaged
GridHead takeGridHead(ByteWindow& window, const FileHead& file, DelayedMetadata treatment);

/// @brief Walk over a list of metadata that is not a grid's, and keep all of it.
/// @throw openvdb::IoError if an entry is longer or shorter than its type
void takeMetadata(ByteWindow& window);

} // namespace openvdb_spheretree::detail
