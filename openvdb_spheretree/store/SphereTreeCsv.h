// SPDX-License-Identifier: Apache-2.0
/// @file SphereTreeCsv.h
/// @brief A SphereTree as comma-separated text, for spreadsheets and scripts.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <iosfwd>

namespace openvdb_spheretree {

/// @brief Write one header line
/// `level,id,parent,x,y,z,radius,i,j,k,radius_sq,scale,origin_i,origin_j,origin_k`, then a row a
/// node, by level from the top, then by id. Center and radius (radiusWorld) are in world space, and
/// read back to the same double. i,j,k is shownVoxel(); radius_sq that of the digital ball, -1 where
/// there is none; what follows is shownGrid().
/// @throw openvdb::IoError if the stream fails
void writeCsv(const SphereTree& tree, std::ostream& out);

/// @brief Write the edges of the Sphere-DAG: one header line `parent,child`, then a row of two ids
/// an edge, sorted.
/// @throw openvdb::IoError if the stream fails
void writeDagCsv(const SphereTree& tree, std::ostream& out);

/// @return whether the tree has a DAG to write, be it one without edges.
inline bool hasDag(const SphereTree& tree) { return tree.hasDag || !tree.dag.empty(); }

/// @return the center of the node's digital ball: at level 0 in the index space of the source grid,
///         above in the level's own grid. Where there is no digital ball, the voxel nearest to the
///         sphere's center, in index space.
openvdb::Coord shownVoxel(const SphereTree& tree, int32_t id, int level);

/// The grid that shownVoxel() is a voxel of: its voxel v has the center
/// scale v + (scale - 1) / 2 + origin in the index space of the source grid. Along the flat axis of a
/// tree with dim = 2 there is no scale: v + origin.
struct ShownGrid {
    int64_t scale = 1; ///< voxels of level 0 along one of its voxels
    openvdb::Coord origin;
};
ShownGrid shownGrid(const SphereTree& tree, int32_t id, int level);

} // namespace openvdb_spheretree
