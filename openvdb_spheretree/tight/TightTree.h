// SPDX-License-Identifier: Apache-2.0
/// @file TightTree.h
/// @brief Tight trees: few spheres for a small error, with the object covered for certain.
///
/// In the trees of the paper, a sphere contains whole leaf balls, and its center is given. A tight
/// tree promises less, and so needs smaller spheres. Every object voxel has a chain of nodes, one a
/// level, each the child of the one above, that all hold the voxel (docs/tight-trees.md).
/// 1. Levels of named counts are made on a coarse level of the object's pyramid, all others on the
///    object (CoarseObject.h). There, leaf balls are the medial balls, without those whose voxels
///    all lie in others, or spheres that were given (LeafBalls.h).
/// 2. Some of many leaf balls are taken, dilated and fitted; then balls are merged and placed anew
///    by turns, down to the counts (FreeCovers.h).
/// 3. These covers become levels, from the top (TopDownLevels.h) or from the bottom
///    (BottomUpLevels.h).
/// 4. Levels are carried down the pyramid to the object (CarriedLevels.h).
/// 5. In a sequence, those of the frame before are taken where they fit about as well
///    (FollowedLevels.h).
/// With cuts=1 or cover=balls, levels are cuts of one forest of merges instead (CutLevels.h).
///
/// Deterministic: the same bytes for any number of threads.

#pragma once

#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree::tight {

/// What a tree may start from, beside its object.
struct TightStart {
    const SphereTree* given =
        nullptr; ///< the leaf balls of leaves=given, in the frame of the object (GivenTree.h)
    const SphereTree* last = nullptr; ///< the tree of the frame before
};

/// @brief Appends all nodes and levels, and the cuts if the settings say so, to a tree that has its
/// settings, object and transform. Stored radii are left to the caller.
/// @param object   that the tree is of
/// @param seconds  must not be null
/// @throw openvdb::ValueError if a bound on the error cannot be reached within the count allowed
void appendTightTree(SphereTree& tree, const openvdb::BoolGrid& object, const TightStart& start,
    openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds);

} // namespace openvdb_spheretree::tight
