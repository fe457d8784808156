// SPDX-License-Identifier: Apache-2.0
/// @file InnerLevels.h
/// @brief The levels of an inner tree: the first N balls of one greedy order (InnerOrder.h), for
/// each N that the budget asks for.
///
/// A ball of a coarser level is in all finer levels, too. The parent of such a ball is itself in the
/// next coarser level. The parent of any other ball is the ball of that level nearest by power
/// distance, of equals the first by center. Radii are stored rounded down, and nothing is added to
/// them.

#pragma once

#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree::detail {

/// @param tree     with settings, object, origin and transform, and no nodes; with flatAxis if dim is 2
/// @param voxels   of the object, flat along z if dim is 2
/// @param seconds  the time of the stages is added to it
/// @throw openvdb::ValueError as MedialLevel, or if a radius does not fit a float
void appendInnerTree(SphereTree& tree, const openvdb::MaskTree& voxels, StageSeconds& seconds,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
