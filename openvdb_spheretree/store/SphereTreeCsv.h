// SPDX-License-Identifier: Apache-2.0
/// @file SphereTreeCsv.h
/// @brief A SphereTree as comma-separated text, for spreadsheets and scripts.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <iosfwd>

namespace openvdb_spheretree {

/// @brief Write one header line `level,id,parent,x,y,z,radius,i,j,k,radius_sq`, then a row a node,
/// by level from the top, then by id. Centre and radius are in world space and read back to the
/// same double; the radius is radiusWorld. i,j,k,radius_sq is the digital ball: in the source's
/// index space at level 0, in its level's own grid above. Of a sphere that is none, radius_sq is -1
/// and i,j,k the nearest voxel, in index space.
/// @throw openvdb::IoError if the stream fails
void writeCsv(const SphereTree& tree, std::ostream& out);

/// @brief Write the edges of the Sphere-DAG by node id: one header line `parent,child`, then a row
/// an edge, sorted.
/// @throw openvdb::IoError if the stream fails
void writeDagCsv(const SphereTree& tree, std::ostream& out);

/// @return whether the tree has a DAG to write, be it one without edges.
inline bool hasDag(const SphereTree& tree) { return tree.hasDag || !tree.dag.empty(); }

/// @return the digital ball's centre as text files show it: at level 0 in the index space of the
///         source grid, which is where the sphere's own centre is, above in the level's own grid.
///         The voxel nearest to a sphere that is no digital ball.
openvdb::Coord shownVoxel(const SphereTree& tree, int32_t id, int level);

} // namespace openvdb_spheretree
