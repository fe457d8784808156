// SPDX-License-Identifier: Apache-2.0
/// @file VdbStream.h
/// @brief Grids from and to `.vdb` files and pipes, with the failures that OpenVDB lets pass.

#pragma once

#include <openvdb/openvdb.h>

#include <iosfwd>
#include <string>

namespace command {

/// @brief Every grid of a `.vdb`, whole and in memory, in the file's order.
/// @param path  a file, or `stdin.vdb`
/// @throw CommandError (input) naming the file: missing, not a .vdb, truncated, damaged, empty, or
///        with another number of voxels than it says
/// @throw Interrupted if the user has asked for a stop
openvdb::GridPtrVec readVdb(const std::string& path);

/// @brief Write grids as a `.vdb`; the same grids give the same bytes: the random identifier that
/// OpenVDB puts in the header is replaced by one computed from the rest.
/// @param out          at its start, open for reading too
/// @param compression  flags of openvdb::io
/// @param seekable     a file, which gets the offsets of its grids; or a pipe
void writeVdb(
    std::iostream& out, const openvdb::GridCPtrVec& grids, uint32_t compression, bool seekable);

} // namespace command
