// SPDX-License-Identifier: Apache-2.0
/// @file LevelErrors.h
/// @brief The exact error of every level of a sphere-tree against its object.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

namespace openvdb_spheretree {

/// @brief Fill in `error` (or `errorUnknown`) of every level of @a tree; and `stored` (or
/// `storedUnknown`), where the tree has its stored radii, as all that are built or read have.
/// A level whose spheres
/// cross more than kMaxUnionRows rows of voxels is not counted (two voxels a million apart have a
/// root sphere of 10^12): its error stays empty, with the reason. Level 0 is, where its spheres are
/// the object's medial balls.
/// @param object  what the tree was built from
/// @throw Interrupted if the interrupter said so; what buildSphereTree() throws, for memory that
///        the object's medial balls need, or their radii; @a tree is then unchanged
/// @note Exact. Cost grows with the surface of the level's spheres and of the object; of level 0,
///       with the object's voxels.
void computeLevelErrors(SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
