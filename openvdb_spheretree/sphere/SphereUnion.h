// SPDX-License-Identifier: Apache-2.0
/// @file SphereUnion.h
/// @brief The union of closed spheres as a sparse set of voxels: which voxel centers lie in any
/// sphere.

#pragma once

#include "ExactSphere.h"
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

/// @brief Every voxel of @a clip that lies in a sphere. Nodes wholly inside one sphere are tiles.
/// @param clip  inclusive; voxels outside are left out
/// @throw openvdb::ValueError if the metric's subdivision is none
/// @note Cost grows with the surface of the spheres (in leaf nodes), not with their volume. Exact:
///       integer arithmetic. Parallel; the result does not depend on threads.
openvdb::MaskTree::Ptr sphereUnion(const std::vector<ExactSphere>& spheres,
    const openvdb::CoordBBox& clip, const SphereMetric& metric = {},
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return the smallest box that holds every voxel center in the spheres.
openvdb::CoordBBox boundingBox(
    const std::vector<ExactSphere>& spheres, const SphereMetric& metric = {});

/// A union that crosses more rows of voxels than this would take gigabytes.
constexpr int64_t kMaxUnionRows = int64_t(1) << 24;

/// @return about how many rows along z the spheres cross: their discs, but no more than all rows of
/// the box; overlaps count again.
double crossedRows(const std::vector<ExactSphere>& spheres, const openvdb::CoordBBox& box,
    const SphereMetric& metric = {});

} // namespace openvdb_spheretree
