// SPDX-License-Identifier: Apache-2.0
/// @file FormatNames.h
/// @brief What our own files say they are, where a writer and a reader on different floors must agree.

#pragma once

#include <string>

namespace openvdb_spheretree::detail {

/// The member `format` of a tree as JSON is this name, a point and a version.
constexpr char kTreeJsonName[] = "vdb_spheretree.tree";
constexpr int kTreeJsonVersion = 1; ///< that is written, and the one that is read

inline std::string treeJsonFormat()
{
    return std::string(kTreeJsonName) + '.' + std::to_string(kTreeJsonVersion);
}

} // namespace openvdb_spheretree::detail
