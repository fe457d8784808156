// SPDX-License-Identifier: Apache-2.0
/// @file MeshFormats.h
/// @brief Strict readers of the four most common mesh formats: OBJ, OFF, PLY, STL.
///
/// Assimp reads them too, but given damaged files of these formats, assimp 5.2.5 loops for ever (a PLY cut in its header), aborts the process (an OFF cut in its first line;
/// Debian builds it with assertions) or quietly returns less than the file promised (a cut OBJ).

#pragma once

#include <openvdb/Types.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

/// The polygons of a file, of any number of corners. Equal points are not joined.
struct PolygonSoup {
    std::vector<openvdb::Vec3d> points;
    std::vector<std::uint32_t> corners; ///< indices into points, polygon after polygon
    std::vector<std::uint32_t> counts;  ///< number of corners of each polygon, >= 3
};

/// @param extension  lower case, with its dot
bool isStrictFormat(const std::string& extension);

/// @param bytes  the whole file
/// @throw openvdb::IoError if anything is wrong with it; the message says where, but does not name
///        the file
/// @throw Interrupted if the interrupter, which may be null, said so
PolygonSoup parseMesh(
    const std::string& extension, std::string bytes, openvdb::util::NullInterrupter* interrupter);

/// The reader of PLY, in PlyFormat.cc.
PolygonSoup parsePly(const std::string& bytes, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
