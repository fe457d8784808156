// SPDX-License-Identifier: Apache-2.0
/// @file VdbStream.h
/// @brief Grids from and to `.vdb` files and pipes, with the failures that OpenVDB lets pass.

#pragma once

#include <openvdb/openvdb.h>

#include <cstdint>
#include <iosfwd>
#include <string>

namespace command {

/// Whether the values of grids are read with their nodes, or stay in the file until they are asked
/// for. Then the file must stay as it is, too; one that is renamed over it does no harm.
enum class Loading {
    Auto, ///< delayed, of files of kLargeFile and more
    Delayed,
    Whole
};

/// Bytes. Reading leaf by leaf takes longer than reading through: that is for files that may not
/// fit into memory, in which values are several times as large, and for little else.
constexpr int64_t kLargeFile = int64_t(1) << 26;

/// @brief Every grid of a `.vdb`, in the file's order.
/// @param path     a file, or `stdin.vdb`, which is read whole whatever @a loading says; so are
///                 files that do not say where their grids are
/// @throw CommandError (input) naming the file: missing, not a .vdb, truncated, damaged, empty, or
///        with another number of voxels than it says. Damaged values that stay in the file are
///        found later, by who asks for them.
/// @throw Interrupted if the user has asked for a stop
openvdb::GridPtrVec readVdb(const std::string& path, Loading loading = Loading::Auto);

/// @brief Write grids as a `.vdb`; the same grids give the same bytes: the random identifier that
/// OpenVDB puts in the header is replaced by one computed from the rest.
/// @param out          at its start, open for reading too
/// @param compression  flags of openvdb::io
/// @param seekable     a file, which gets the offsets of its grids; or a pipe
void writeVdb(
    std::iostream& out, const openvdb::GridCPtrVec& grids, uint32_t compression, bool seekable);

} // namespace command
