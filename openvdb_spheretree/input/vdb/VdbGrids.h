// SPDX-License-Identifier: Apache-2.0
/// @file VdbGrids.h
/// @brief The grids of a `.vdb` from anyone: damage ends in an exception, and never in damaged memory,
/// as it may where OpenVDB reads the file unguarded.

#pragma once

#include <openvdb/openvdb.h>

#include <optional>
#include <streambuf>
#include <string>
#include <vector>

namespace openvdb_spheretree {

/// @brief Read every grid of a `.vdb`, in the file's order.
///
/// The same grids as `openvdb::io::Stream` reads, for all files of OpenVDB 1.0 and later with grids of
/// the types that openvdb::initialize() registers. Memory: the grids, 1 MiB, and for a time 64 bytes for
/// each leaf of a grid. OpenVDB must have been initialized.
/// @param source  at the file's start; what follows the last grid may or may not be taken from it
/// @throw openvdb::IoError, or another exception of OpenVDB's, if the file is truncated, damaged or of
///        a type that is not read; and whatever the source throws
openvdb::GridPtrVec readVdbGrids(std::streambuf& source);

/// @brief Look whether a `.vdb` is fit to be opened by `openvdb::io::File` with delayed loading: whether
/// all its lengths and offsets are right. The file must not change from then on.
/// @return the names by which io::File knows the grids, in the file's order; none if the file does not
///         say where they are, so that io::File cannot open it
/// @throw as readVdbGrids()
std::optional<std::vector<std::string>> requireSoundVdb(std::streambuf& source);

} // namespace openvdb_spheretree
