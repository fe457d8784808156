// SPDX-License-Identifier: Apache-2.0
/// @file SphereTree.h
/// @brief The result: a hierarchy of spheres over an object, as flat arrays.
///
/// Nodes are ordered from the top level to level 0, and by level-grid coordinate (x first) within a
/// level; the index of a node is its id. A parent therefore always stands before its children, and
/// a level is a range of ids.
///
/// Two radii belong to a node. `radius` makes a closed sphere that holds every *voxel center* the
/// node answers for; it is what the errors are counted with. `radiusWorld` is the radius as it is
/// stored in files: in world units, with the padding added, rounded up to a float, so that whatever
/// was covered stays covered. Spheres of an inner tree (InnerBalls.h) lie inside the object
/// instead: their radii are rounded down, and nothing is added.

#pragma once

#include "SphereCuts.h"
#include "SphereTreeSettings.h"
#include "Spheres.h"
#include <openvdb_spheretree/topology/LevelTopology.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace openvdb_spheretree {

/// How far the union of a level's spheres is from the object, counted in voxels, exactly.
struct LevelError {
    int64_t covered = 0;       ///< voxels whose center lies in a sphere of the level
    int64_t excess = 0;        ///< covered, but not in the object
    int64_t missing = 0;       ///< in the object, but not covered: 0 for all trees but inner ones
    double hammingPercent = 0; ///< 100 (excess + missing) / object voxels
    double hausdorff = 0;      ///< largest distance of a covered voxel to the object, in voxels
};

/// How far the spheres of a level are from the object as files have them: with radii in floats,
/// padding and all.
struct StoredError {
    /// 100 (excess + missing) / object voxels, of voxels whose center lies in a stored sphere.
    double hammingPercent = 0;
    /// No point of a stored sphere is farther than this from the object's voxel cubes: an upper
    /// bound, by at most 0.055 voxel (StoredReach.h). World units.
    double reachWorld = 0;
};

struct SphereTreeLevel {
    int level = 0;                         ///< 0 is the finest
    int32_t begin = 0, end = 0;            ///< the level's nodes are [begin, end)
    int64_t pyramidVoxels = 0;             ///< voxels of the volume whose medial balls these are
    std::optional<LevelTopology> topology; ///< of these voxels; empty if not asked for
    std::optional<LevelError> error;       ///< empty until computed, or when out of reach
    std::string errorUnknown;              ///< why `error` is empty, where it was asked for
    std::optional<StoredError> stored;     ///< where `error` is, but in files of version 0.1
    std::string storedUnknown;             ///< why `stored` is empty where `error` is not

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
    Spheres spheres; ///< a parent is on the next level up
    /// The center of the node's digital ball, in the grid of its level. Of a sphere that is no
    /// digital ball: the voxel nearest to its center.
    std::vector<openvdb::Coord> ijk;
    /// Of the node's digital ball {q : |q - ijk|^2 < radiusSq} (MedialBall.h). -1 for a sphere that
    /// is no digital ball.
    std::vector<int32_t> radiusSq;
    /// Of a tree that belongs to a sequence: the same number in all frames for what is the same sphere, and
    /// no other (SphereTracks.h). Empty for other trees.
    std::vector<int32_t> track;
    /// @}
    int32_t nextTrack = 0; ///< above all tracks that there have been in the sequence
    /// Units of centers and coverRadiusSq in a voxel: 2 or 16, or 1024 of given spheres.
    int subdivision = 2;
    std::vector<SphereTreeLevel> levels; ///< level 0 first
    std::vector<DagEdge> dag;            ///< sorted, unique; empty unless asked for
    SphereCuts cuts;                     ///< empty unless asked for
    /// @name Whether edges and cuts are those of the whole tree: a single level has neither
    /// @{
    bool hasDag = false, hasCuts = false;
    /// @}
    /// With dim = 2, the axis along which the object is one voxel thick: 0, 1 or 2 for x, y, z.
    int flatAxis = 2;

    SphereTreeSettings settings; ///< what was asked for
    ObjectInfo object;
    openvdb::Coord origin; ///< level-grid (0,0,0) in index space; multiples of 8
    openvdb::SharedPtr<openvdb::math::Transform>
        transform; ///< of the source grid: index space to world

    int32_t size() const { return spheres.size(); }
    /// @return the top level; the tree must have one, as every tree built or read has.
    const SphereTreeLevel& root() const { return levels.back(); }
    /// @return whether there is a level of this number; a tree need not have level 0.
    bool hasLevel(int number) const;
    /// @return the level of this number.
    /// @throw openvdb::ValueError if there is none
    const SphereTreeLevel& level(int number) const;
    /// @return the number of the level of node @a id; O(levels).
    /// @throw openvdb::LookupError if there is no such node
    int levelOf(int32_t id) const;
    openvdb::Vec3d centerWorld(int32_t id) const;
    double voxelSize() const;

    /// @brief What functions that take a tree rely on: arrays of one length, levels that divide
    /// them, numbers that spheres have, parents and edges to the next level, cuts of every number
    /// of spheres, settings that fit together.
    /// @throw openvdb::ValueError naming the first thing that is wrong. Cost: linear.
    void validate() const;
};

/// @return a tree of one level, ids renumbered from 0, every node a root.
/// @throw openvdb::ValueError if @a tree has no such level.
SphereTree keepLevel(const SphereTree& tree, int level);

/// @return a tree of one level: the cut of at most so many spheres if the tree has cuts, else the finest level
///         that has no more.
/// @throw openvdb::ValueError if every level has more, or @a spheres is less than 1
SphereTree keepSpheres(const SphereTree& tree, int64_t spheres);

} // namespace openvdb_spheretree
