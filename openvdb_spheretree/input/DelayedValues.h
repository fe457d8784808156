// SPDX-License-Identifier: Apache-2.0
/// @file DelayedValues.h
/// @brief Whether all values of a grid can be read that OpenVDB has left in its file (delayed loading).

#pragma once

#include <openvdb/Grid.h>
#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {

/// @brief See to it that the values of all leaves can be unpacked, and keep none of them. To be asked
/// before anything reads values in place: a leaf of OpenVDB 10 that fails to load damages the heap when
/// it is destroyed.
///
/// Nothing is done for leaves that are in memory. Cost: all values that are in the file are read once, in
/// parallel; memory: a leaf a thread.
/// @throw openvdb::Exception if the file is damaged, or has changed
/// @throw Interrupted if the interrupter said so
void requireReadableValues(
    const openvdb::GridBase& grid, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
