// SPDX-License-Identifier: Apache-2.0
/// @file SphereTreeJson.h
/// @brief A SphereTree as JSON, for programs and scripts; nothing of it is lost but the clock.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <iosfwd>

namespace openvdb_spheretree {

/// @brief Write one object:
///
///     { "format": "vdb_spheretree.tree.1",
///       "object": {"name", "voxels", "leaves", "tiles", "bbox_min": [3], "bbox_max": [3],
///                  "voxel_size", "origin": [3]},
///       "settings": {every option of the build, with its value},
///       "transform": [16],
///       "subdivision": 2,
///       "levels": [{"level", "begin", "end", "pyramid_voxels",
///                   "topology": {"components", "tunnels", "cavities"}, "covered", "excess",
///                   "missing", "hamming_percent", "hausdorff"}, ...],
///       "columns": [16 names],
///       "nodes": [[a number for each column], ...],
///       "dag": [[parent, child], ...],
///       "cuts": {"columns": [13 names], "nodes": [[a number for each column], ...]} }
///
/// - `transform` takes index space to world: rows of a 4 x 4 matrix for row vectors (x, y, z, 1),
///   the translation last.
/// - `levels`: 0 first. Their nodes have the ids begin to end - 1. Topology and errors are null
///   where they were not counted; `error_unknown` says why.
/// - `nodes` come by id. Their first eleven columns are those of the .csv (SphereTreeCsv.h). Then
///   come the center in index space, the radius in voxels without padding, and its exact form
///   `cover_sq`, in squares of 1 / `subdivision` voxel, which may exceed 2^53.
/// - `dag` is sorted, and null in a tree without edges. `cuts` (SphereCuts.h) is null in a tree
///   without.
///
/// Numbers read back to the same value. Memory does not grow with the tree.
/// @throw openvdb::IoError if the stream fails
void writeJson(const SphereTree& tree, std::ostream& out);

} // namespace openvdb_spheretree
