// SPDX-License-Identifier: Apache-2.0
/// @file MiniballCenters.h
/// @brief center=miniball: the spheres of a finished reversible or extended tree become the
/// smallest ones around the leaf balls below them, which Broutta et al. 2009 name as future work.
///
/// Parents, levels and digital balls stay as they are; only centers and radii change. Per level:
/// 1. which leaf balls are below which node;
/// 2. `smallestSphere`, a node each: the smallest ball in floating point (Miniball.h), its center
///    rounded to 1/16 voxel, and the radius around *that* measured exactly, rounded up;
/// 3. an extended tree keeps the medial center where rounding has made its sphere the smaller one.
///
/// So every node contains the leaf balls below it, those of reversible trees too, and every level
/// covers the object. Nodes of a reversible tree with no leaf ball below keep their own spheres.
/// The others may not choose between their own and the new one by size alone: with the smaller of
/// both, levels 1 to 5 of Al.100 miss 14, 11, 1, 32 and 1173 voxels, since a node's own sphere need
/// not contain the leaf balls below it.
///
/// Al.100, levels 1 to 7, % error before and after. Extended: 60, 168, 283, 419, 773, 2086, 3076 to
/// 38, 80, 122, 261, 418, 477, 734; reversible: 34, 106, 268, 579, 1185, 2927, 7815 to 43, 99, 271,
/// 493, 870, 1435, 734. (Trying all eight roundings of a center takes off 0.3 at level 1.)
///
/// Exact, but for which of almost equal centers is chosen. The same for any number of threads:
/// nodes are independent. Cost: leaves x levels x some ten distances. Tests:
/// TestMiniballCenters.cc.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

namespace openvdb_spheretree::detail {

/// @param tree  with everything but radiusWorld and subdivision; Euclidean
/// @throw openvdb::ValueError if the squares of its radii do not fit
void centerOnMiniballs(SphereTree& tree, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
