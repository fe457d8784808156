// SPDX-License-Identifier: Apache-2.0
/// @file PointWalk.h
/// @brief The leaves of a PointDataGrid as a `.vdb` has them: in passes, each over all leaves.
///
/// With n attributes there are 2 n + 4 passes: how long each leaf's voxel values are; descriptors and
/// sizes of attributes; headers of the pages of attribute 1, ..., n; the voxel values; the pages of
/// attribute 1, ..., n; nothing. A page holds an attribute of many leaves, packed by Blosc. Without
/// Blosc there are no pages, and each leaf's attribute stands for itself.
/// (After OpenVDB 10, which reads them in PointDataLeafNode::readBuffers.)

#pragma once

#include "BufferWalk.h"

namespace openvdb_spheretree::detail {

std::unique_ptr<BufferWalk> walkPoints(const BlockFormat& format, size_t leafCount);

} // namespace openvdb_spheretree::detail
