// SPDX-License-Identifier: Apache-2.0
/// @file SphereTreeJson.h
/// @brief A SphereTree as JSON, for programs and scripts; nothing of it is lost but the clock.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <iosfwd>

namespace openvdb_spheretree {

class JsonWriter;

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
/// `transform` takes index space to world: rows of a 4 x 4 matrix for row vectors (x, y, z, 1), the
/// translation last. Levels: 0 first; their nodes have the ids begin to end - 1; errors and
/// topology are null where they were not counted (`error_unknown` says why). Nodes come by id,
/// which is their place. Their first eleven columns are those of the .csv (SphereTreeCsv.h); then
/// the centre in index space, the radius in voxels without padding, and its exact form `cover_sq`,
/// which may exceed 2^53 and counts squares of 1 / `subdivision` voxel. `dag` is sorted, and null
/// in a tree without edges; `cuts` is null in a tree without (SphereCuts.h). Numbers read back to
/// the same value.
///
/// Written as it goes: memory does not grow with the tree.
/// @throw openvdb::IoError if the stream fails
void writeJson(const SphereTree& tree, std::ostream& out);

/// @name Members which -stats has as well: "object", "settings", and a level's topology and error
/// @{
void writeObject(JsonWriter& json, const SphereTree& tree);
/// The members of "settings", which the caller has begun.
void writeSettings(JsonWriter& json, const SphereTree& tree);
void writeTopology(JsonWriter& json, const SphereTreeLevel& level);
void writeError(JsonWriter& json, const SphereTreeLevel& level);
/// @}

} // namespace openvdb_spheretree
