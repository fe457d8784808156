// SPDX-License-Identifier: Apache-2.0
/// @file VdbDamage.h
/// @brief Where a file is damaged whose digest says that it is: by the checksums that the parts of its
/// trees have.

#pragma once

#include <openvdb/openvdb.h>

#include <string>

namespace command {

/// @return what changed, as clauses for a message: parts of trees by name, the first few; or that these are whole, and
///         it is elsewhere; or that the file has none that would tell; or that memory is short. Linear in the nodes of
///         trees
/// @throw Interrupted if a stop has been requested
std::string placeOfDamage(const openvdb::GridPtrVec& grids);

} // namespace command
