// SPDX-License-Identifier: Apache-2.0
/// @file NearestLevels.h
/// @brief The levels of a tree with side=fit: for each number of spheres that the budget asks for, the nearest ones
/// that a search finds.
///
/// 1. The first N inner spheres (InnerOrder.h) are the start of the search for N (NearestSearch.h). Levels are
///    searched by themselves, each as if it were the only one.
/// 2. Radii are rounded to floats, and the spheres are those of the floats (StoredSphere.h).
/// 3. A level that comes out worse than a coarser one is searched again, from the spheres of the coarser one and
///    those of what these miss: no level has a larger error than a coarser one.
/// 4. With a bound on the error, numbers are doubled from 1 on until it holds. Between the last two, guesses by a power
///    law and halving take turns.
/// 5. Parents: SharedVoxels.h. Tests: TestNearestTree.cc.

#pragma once

#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree::nearest {

/// @param tree     with settings, object, origin and transform, and no nodes; with flatAxis if dim is 2
/// @param voxels   of the object, flat along z if dim is 2
/// @param seconds  the time of the stages is added to it
/// @throw openvdb::ValueError as MedialLevel; if a radius does not fit a float; if the bound on the error needs
///        more spheres than the budget allows
void appendNearestTree(SphereTree& tree, const openvdb::MaskTree& voxels, StageSeconds& seconds,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::nearest
