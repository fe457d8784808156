// SPDX-License-Identifier: Apache-2.0
/// @file VdbSamples.h
/// @brief Grids of every type that OpenVDB reads, whose nodes are stored in every way that it has; and
/// their `.vdb` as bytes.

#pragma once

#include <openvdb/openvdb.h>

#include <cstdint>
#include <string>
#include <vector>

namespace spheretree_test {

/// A grid of each registered type, with tiles, empty, full and mixed leaves, on both sides of the
/// origin; the real ones in full and in half precision; points with groups, strings and strides, a
/// grid without nodes, one with a frustum transform, and one that shares the nodes of another.
openvdb::GridPtrVec vdbSamples();

/// @return a grid of point indices. OpenVDB cannot read one back that has more than one leaf.
openvdb::GridBase::Ptr pointIndexSample(int count);

/// Every combination of flags of openvdb::io by which a grid can be compressed.
std::vector<uint32_t> vdbCompressions();

/// @return a `.vdb` without offsets, as through a pipe.
std::string vdbBytes(const openvdb::GridPtrVec& grids, uint32_t compression);

/// @return what a grid is: its `.vdb` but for the file's random identifier, and for the bytes it takes
/// in memory, which depend on what is loaded. By Blosc, for otherwise OpenVDB 10 leaves attributes out
/// that are not loaded yet.
std::string contentOf(const openvdb::GridBase::Ptr& grid);

} // namespace spheretree_test
