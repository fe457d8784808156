// SPDX-License-Identifier: Apache-2.0
/// @file IntersectionDag.h
/// @brief The other Sphere-DAG, for study: an edge for every pair of spheres of consecutive levels
/// that meet (Broutta et al. 2009, 3.1, Eq. 3).
///
/// Spheres are closed, in the frame of level 0, without padding, as the tree has them (`coverSq`);
/// touching is meeting. Each level's spheres are put in a bounding volume hierarchy, where each
/// sphere of the level below is looked up. Exact, in integers. In a reversible tree every edge of
/// SphereDag.h is among these; the other way round most are not. Cost: O(n log n + edges), where
/// spheres of a level are alike in size. Tests: TestIntersectionDag.cc.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree {

/// @return the edges of all levels of @a tree by node id, sorted and unique.
/// @throw openvdb::ValueError if there are more than 2^28
/// @throw Interrupted if the interrupter (may be null) said so
std::vector<DagEdge> intersectionDag(
    const SphereTree& tree, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
