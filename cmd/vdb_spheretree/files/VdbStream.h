// SPDX-License-Identifier: Apache-2.0
/// @file VdbStream.h
/// @brief Grids from and to `.vdb` files and pipes. Failures that OpenVDB ignores are errors here.

#pragma once

#include <openvdb/openvdb.h>

#include <cstdint>
#include <iosfwd>
#include <string>

namespace command {

/// When the values of grids are read.
enum class Loading {
    Auto,    ///< Delayed for files of kLargeFile and more, else Whole
    Delayed, ///< when they are first used; the file must not change, but may be replaced by rename
    Whole    ///< together with the nodes
};

/// Bytes. Values take several times as much in memory as in the file. Delayed reading, leaf by leaf,
/// is slower, and pays only where values may not fit into memory.
constexpr int64_t kLargeFile = int64_t(1) << 26;

/// @brief Read every grid of a `.vdb`, in the file's order.
/// @param path     a file, or `stdin.vdb`. Standard input is always read whole, and so are files
///                 that do not say where their grids are.
/// @throw CommandError (input) naming the file, if it is missing, no .vdb, truncated, damaged or
///        empty, or if a grid has another number of voxels than the file says. With delayed loading,
///        damaged values are found when they are first used.
/// @throw Interrupted if a stop has been requested
openvdb::GridPtrVec readVdb(const std::string& path, Loading loading = Loading::Auto);

/// @brief Write grids as a `.vdb`. The same grids give the same bytes: the random identifier that
/// OpenVDB puts in the header is replaced by one computed from the rest of the file.
/// @param out          at its start, open for reading too
/// @param compression  flags of openvdb::io
/// @param seekable     whether to write the offsets of the grids; false for a pipe
void writeVdb(
    std::iostream& out, const openvdb::GridCPtrVec& grids, uint32_t compression, bool seekable);

} // namespace command
