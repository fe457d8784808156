// SPDX-License-Identifier: Apache-2.0
/// @file SphereTree.h
/// @brief The result: a hierarchy of spheres over an object, as flat arrays.
///
/// Nodes are ordered from the top level to level 0, and by level-grid coordinate (x first) within a
/// level; the index of a node is its id. A parent therefore always stands before its children, and
/// a level is a range of ids.
///
/// Two radii belong to a node. `radius` makes a closed sphere that holds every *voxel centre* the
/// node answers for; it is what the errors are counted with. `radiusWorld` is the radius as it is
/// stored in files: in world units, with the padding added, rounded up to a float, so that whatever
/// was covered stays covered. Spheres of an inner tree (InnerBalls.h) lie inside the object instead:
/// their radii are rounded down, and nothing is added.

#pragma once

#include "SphereCuts.h"
#include "SphereTreeSettings.h"
#include <openvdb_spheretree/topology/LevelTopology.h>

#include <openvdb/openvdb.h>
#include <openvdb/math/Transform.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace openvdb_spheretree {

/// How far the union of a level's spheres is from the object, counted in voxels, exactly.
struct LevelError {
    int64_t covered = 0;       ///< voxels whose centre lies in a sphere of the level
    int64_t excess = 0;        ///< covered, but not in the object
    int64_t missing = 0;       ///< in the object, but not covered: 0 for all trees but inner ones
    double hammingPercent = 0; ///< 100 (excess + missing) / object voxels
    double hausdorff = 0;      ///< largest distance of a covered voxel to the object, in voxels
};

struct SphereTreeLevel {
    int level = 0;                         ///< 0 is the finest
    int32_t begin = 0, end = 0;            ///< the level's nodes are [begin, end)
    int64_t pyramidVoxels = 0;             ///< voxels of the volume whose medial balls these are
    std::optional<LevelTopology> topology; ///< of these voxels; empty if not asked for
    std::optional<LevelError> error;       ///< empty until computed, or when out of reach
    std::string errorUnknown;              ///< why `error` is empty, where it was asked for

    int32_t size() const { return end - begin; }
};

/// The object a tree was built from.
struct ObjectInfo {
    std::string name; ///< of the source grid
    int64_t voxels = 0, leaves = 0, tiles = 0;
    openvdb::CoordBBox bbox; ///< of the active voxels, inclusive
};

/// An edge of the Sphere-DAG, by node id: `parent` is one level above `child`.
struct DagEdge {
    int32_t parent = 0, child = 0;
    bool operator==(const DagEdge& o) const { return parent == o.parent && child == o.child; }
    bool operator<(const DagEdge& o) const
    {
        return parent != o.parent ? parent < o.parent : child < o.child;
    }
};

struct SphereTree {
    /// @name One entry a node
    /// @{
    /// Index space of the source grid; multiples of 1 / subdivision.
    std::vector<openvdb::Vec3d> center;
    std::vector<double> radius; ///< voxels of level 0, covers voxel centres, no padding
    /// The exact form of `radius`: voxel centre q is inside when
    /// |subdivision (q - center)|^2 <= coverSq, the length being that of settings.dist, in its units.
    std::vector<int64_t> coverSq;
    /// World units, padded, rounded up. Of a norm: how far the ball reaches along an axis of index
    /// space; a sphere of this radius holds more than it (l1), or less (linf).
    std::vector<float> radiusWorld;
    std::vector<int32_t> parent; ///< id on the next level up; -1 where there is none
    /// The digital ball's centre in its level's own grid; for a sphere that is none, the voxel
    /// nearest to its centre.
    std::vector<openvdb::Coord> ijk;
    /// The digital ball {q : |q - ijk|^2 < radiusSq}: MedialBall; -1 for a sphere that is none.
    std::vector<int32_t> radiusSq;
    /// @}
    /// Units of centres and coverSq in a voxel: 2 or 16.
    int subdivision = 2;
    std::vector<SphereTreeLevel> levels; ///< level 0 first
    std::vector<DagEdge> dag;            ///< sorted, unique; empty unless asked for
    SphereCuts cuts;                     ///< empty unless asked for

    SphereTreeSettings settings;
    ObjectInfo object;
    openvdb::Coord origin;                   ///< level-grid (0,0,0) in index space; multiples of 8
    openvdb::math::Transform::Ptr transform; ///< of the source grid: index space to world

    int32_t size() const { return int32_t(center.size()); }
    /// @return the top level; the tree must have one, as every tree built or read has.
    const SphereTreeLevel& root() const { return levels.back(); }
    /// @return the level of node @a id; O(levels).
    int levelOf(int32_t id) const;
    openvdb::Vec3d centerWorld(int32_t id) const { return transform->indexToWorld(center[id]); }
    double voxelSize() const { return transform->voxelSize()[0]; }
};

/// @return a tree of one level, ids renumbered from 0, every node a root.
/// @throw openvdb::ValueError if @a tree has no such level.
SphereTree keepLevel(const SphereTree& tree, int level);

} // namespace openvdb_spheretree
