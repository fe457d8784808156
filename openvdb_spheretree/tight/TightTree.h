// SPDX-License-Identifier: Apache-2.0
/// @file TightTree.h
/// @brief Tight trees: few spheres for a small error, with the object covered for certain.
///
/// The trees of the paper pay for containing whole leaf balls around centres that are given. A tight
/// tree owes less: every object voxel has a chain of nodes, one a level, each the child of the one
/// above, that all hold it (DESIGN 10). How one is made, step by step:
/// 1. medial balls of the object, without those that others make superfluous (LeafPruning.h);
/// 2. pairs of neighbours merge, the cheapest first, down to one ball (MergeForest.h): a binary
///    forest, any cut of which is a cover;
/// 3. levels are cuts of the forest, by count or by the error allowed.
///
/// Deterministic: the same bytes for any number of threads.

#pragma once

#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {
namespace tight {

/// @brief Append all nodes and levels, and the cuts if asked for, to a tree that has its settings,
/// object and transform; stored radii are left to the caller.
/// @param object   what the tree is of
/// @param seconds  must not be null
/// @throw openvdb::ValueError if a bound on the error cannot be reached within the count allowed
void appendTightTree(SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds);

} // namespace tight
} // namespace openvdb_spheretree
