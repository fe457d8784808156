// SPDX-License-Identifier: Apache-2.0
/// @file DelayedSizes.h
/// @brief What a `.vdb` says of its leaves in advance (io::DelayedLoadMetadata), so that OpenVDB can
/// skip their values without reading their lengths. It believes every one of them.

#pragma once

#include "ByteWindow.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// An entry for each leaf, in the order of the file.
struct DelayedSizes {
    std::vector<int8_t> selections;   ///< as ValueBlock::selection
    std::vector<int64_t> storedBytes; ///< as ValueBlock::storedBytes; empty where nothing is packed
};

/// @brief Walk over the value of such a metadata entry.
/// @param bytes  of the value; 0 if the grid has no leaf
/// @throw openvdb::IoError if a length in it is wrong
DelayedSizes takeDelayedSizes(ByteWindow& window, uint32_t bytes);

} // namespace openvdb_spheretree::detail
