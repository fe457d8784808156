// SPDX-License-Identifier: Apache-2.0
/// @file MedialCover.h
/// @brief Whether the spheres of a level are the object's medial balls: then their union is known.
///
/// Drawing thousands of large balls into every leaf of a solid's surface takes far longer than the
/// transforms do. So the medial balls of the object are found anew, and compared. Where they are
/// the level's spheres, the union is the object, voxel by voxel: every voxel has a label, a medial
/// ball that holds it, and no ball reaches beyond the object, as its radius is the distance of its
/// center (docs/algorithm.md, "Medial balls").

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>

namespace openvdb_spheretree::detail {

/// @return whether the spheres of @a level are the medial balls of @a object. False as well where
///         that is not worth finding out: few balls, which are drawn faster than it takes.
/// @param voxels  of the object
/// @throw as buildSphereTree()
bool areMedialBalls(const SphereTree& tree, const SphereTreeLevel& level,
    const openvdb::MaskTree& object, int64_t voxels, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
