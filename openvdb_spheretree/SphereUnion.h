// SPDX-License-Identifier: Apache-2.0
/// @file SphereUnion.h
/// @brief The union of closed spheres as a sparse set of voxels: which voxel centres lie in any
/// sphere.

#pragma once

#include "SphereTree.h"

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

/// The closed sphere { q : |2 q - center2|^2 <= coverSq }, in voxels of the grid it is drawn on;
/// with the length of a norm where one is given beside it.
/// Twice the centre, so that centres between voxels stay integers.
struct ExactSphere {
    int64_t center2[3];
    int64_t coverSq; ///< negative: empty
};

/// @brief Every voxel of @a clip that lies in a sphere. Nodes wholly inside one sphere are tiles.
/// @param clip  inclusive; voxels outside are left out
/// @note Cost grows with the surface of the spheres (in leaf nodes), not with their volume. Exact:
///       integer arithmetic. Parallel; the result does not depend on threads.
openvdb::MaskTree::Ptr sphereUnion(const std::vector<ExactSphere>& spheres,
    const openvdb::CoordBBox& clip, openvdb::util::NullInterrupter* interrupter = nullptr,
    const Distance& distance = {});

/// @return the spheres of a level, in index space of the tree's source grid (without padding).
std::vector<ExactSphere> levelSpheres(const SphereTree& tree, const SphereTreeLevel& level);

/// @return the smallest box that holds every voxel centre in the spheres.
openvdb::CoordBBox boundingBox(
    const std::vector<ExactSphere>& spheres, const Distance& distance = {});

/// @return that box for spheres of a level of @a tree; in 2-D only their plane.
openvdb::CoordBBox levelBox(const SphereTree& tree, const std::vector<ExactSphere>& spheres);

/// A union that crosses more rows of voxels than this would take gigabytes.
constexpr int64_t kMaxUnionRows = int64_t(1) << 24;

/// @return about how many rows along z the spheres cross: their discs, but no more than all rows of
/// the box; overlaps count again.
double crossedRows(const std::vector<ExactSphere>& spheres, const openvdb::CoordBBox& box,
    const Distance& distance = {});

/// @brief The voxels that a level covers: those whose centres lie in its spheres.
/// @throw openvdb::ValueError if they cross more than kMaxUnionRows
openvdb::MaskTree::Ptr levelUnion(const SphereTree& tree, const SphereTreeLevel& level,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
