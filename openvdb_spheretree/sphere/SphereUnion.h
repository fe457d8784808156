// SPDX-License-Identifier: Apache-2.0
/// @file SphereUnion.h
/// @brief The union of closed spheres as a sparse set of voxels: which voxel centres lie in any
/// sphere.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

/// What the spheres of a list have in common: the distance they are balls of, and the units of
/// their integers. Where only a distance is given, units are halves of a voxel.
struct SphereMetric {
    Distance distance;
    /// Units in a voxel: SphereTree::subdivision. A power of two, 2 to kMaxSubdivision.
    int subdivision = 2;

    static constexpr int kMaxSubdivision = 16;

    SphereMetric() = default;
    SphereMetric(const Distance& distance, int subdivision = 2)
        : distance(distance), subdivision(subdivision)
    {}
};

/// @return that of the spheres of a tree.
SphereMetric metricOf(const SphereTree& tree);

/// The closed sphere { q : |subdivision q - center|^2 <= coverSq } of voxels q of the grid it is
/// drawn on; subdivision and length are those of the SphereMetric beside it. So centres between
/// voxels stay integers.
struct ExactSphere {
    int64_t center[3];
    int64_t coverSq; ///< negative: empty
};

/// @brief Every voxel of @a clip that lies in a sphere. Nodes wholly inside one sphere are tiles.
/// @param clip  inclusive; voxels outside are left out
/// @throw openvdb::ValueError if the metric's subdivision is none
/// @note Cost grows with the surface of the spheres (in leaf nodes), not with their volume. Exact:
///       integer arithmetic. Parallel; the result does not depend on threads.
openvdb::MaskTree::Ptr sphereUnion(const std::vector<ExactSphere>& spheres,
    const openvdb::CoordBBox& clip, openvdb::util::NullInterrupter* interrupter = nullptr,
    const SphereMetric& metric = {});

/// @return the spheres of a level, in index space of the tree's source grid (without padding), by
///         metricOf() the tree.
std::vector<ExactSphere> levelSpheres(const SphereTree& tree, const SphereTreeLevel& level);

/// @return the smallest box that holds every voxel centre in the spheres.
openvdb::CoordBBox boundingBox(
    const std::vector<ExactSphere>& spheres, const SphereMetric& metric = {});

/// @return that box for spheres of a level of @a tree; in 2-D only their plane.
openvdb::CoordBBox levelBox(const SphereTree& tree, const std::vector<ExactSphere>& spheres);

/// A union that crosses more rows of voxels than this would take gigabytes.
constexpr int64_t kMaxUnionRows = int64_t(1) << 24;

/// @return about how many rows along z the spheres cross: their discs, but no more than all rows of
/// the box; overlaps count again.
double crossedRows(const std::vector<ExactSphere>& spheres, const openvdb::CoordBBox& box,
    const SphereMetric& metric = {});

/// @brief The voxels that a level covers: those whose centres lie in its spheres.
/// @throw openvdb::ValueError if they cross more than kMaxUnionRows
openvdb::MaskTree::Ptr levelUnion(const SphereTree& tree, const SphereTreeLevel& level,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
