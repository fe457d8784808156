// SPDX-License-Identifier: Apache-2.0
/// @file PointDescriptor.h
/// @brief What a `.vdb` says of the attributes of a leaf of points: their types, names and groups.

#pragma once

#include "ByteWindow.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// @brief Walk over a descriptor.
/// @return for each attribute, bytes of one of its values.
/// @throw openvdb::IoError if a name or group leads to an attribute that is not there: OpenVDB would
///        read behind its array of attributes
/// @throw openvdb::KeyError if an attribute's type is unknown
std::vector<uint32_t> takePointDescriptor(ByteWindow& window);

} // namespace openvdb_spheretree::detail
