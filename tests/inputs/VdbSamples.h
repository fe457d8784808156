// SPDX-License-Identifier: Apache-2.0
/// @file VdbSamples.h
/// @brief What samples that are `.vdb` files share: the object, and the bytes of a file.

#pragma once

#include <openvdb/openvdb.h>

#include <string>

namespace spheretree_test {

/// Two blobs of some 100 voxels in four leaves, on both sides of zero.
openvdb::BoolGrid::Ptr sampleObject();

/// Who has put the identifier into a file.
enum class Saver {
    Command, ///< it is a digest of the file, and any damage is refused in the end
    OpenVdb  ///< it is random, and damage must be found by what it does
};

/// @brief What the command writes.
/// @param compression  flags of openvdb::io
/// @param seekable     false for what goes through a pipe
std::string vdbBytes(const openvdb::GridCPtrVec& grids, uint32_t compression, bool seekable = true,
    Saver saver = Saver::OpenVdb);

/// @name Values of `codec=` of the command
/// @{
constexpr uint32_t kNone = openvdb::io::COMPRESS_NONE;
constexpr uint32_t kActive = openvdb::io::COMPRESS_ACTIVE_MASK;
constexpr uint32_t kZip = openvdb::io::COMPRESS_ZIP | kActive;
constexpr uint32_t kBlosc = openvdb::io::COMPRESS_BLOSC | kActive;
/// @}

} // namespace spheretree_test
