// SPDX-License-Identifier: Apache-2.0
/// @file BenchmarkObject.h
/// @brief The objects that are measured: files of the folder SPHERETREE_DATA, and objects by rule.

#pragma once

#include <openvdb/openvdb.h>

#include <functional>
#include <string>
#include <vector>

namespace spheretree_benchmark {

struct BenchmarkObject {
    std::string name;                                 ///< such as `dragon-512` or `gyroid-1e6`
    std::string family;                               ///< of objects by rule: `gyroid`; else empty
    std::string path;                                 ///< of a file; else empty
    std::function<openvdb::GridBase::Ptr()> makeGrid; ///< anew with every call, not yet a mask

    bool isVolume() const; ///< whether it is read from a .vol
};

/// @param largest  whether to name those of more than a million leaf nodes, too
std::vector<std::string> namesOfObjects(bool largest);

/// @param name  `SHAPE-VOXELS` (GeneratedObject.h), `level-set-ball`, `balls-1e6-apart` (two balls a
///              million voxels apart), or a file's name without folder and extension
/// @throw openvdb::ValueError if there is no such object, naming where its file should be
BenchmarkObject objectByName(const std::string& name);

/// @throw openvdb::IoError if it cannot be read, or holds another number of grids than one
openvdb::GridBase::Ptr readVdbFile(const std::string& path);

} // namespace spheretree_benchmark
