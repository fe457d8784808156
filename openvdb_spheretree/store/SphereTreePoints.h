// SPDX-License-Identifier: Apache-2.0
/// @file SphereTreePoints.h
/// @brief A SphereTree to an OpenVDB point grid and back, without loss.
///
/// One point a node. Positions are uncompressed floats (NullCodec) and exact: the point grid's
/// transform is the source's, scaled by a power of two. Attributes: `pscale` (float, radiusWorld),
/// `id`, `parent`, `level`, `radius_sq` (int32), `ijk` (vec3i), `radius` (double), `cover_sq`
/// (int64), and the groups `level_0`, `level_1`, ... Everything else is grid metadata, under keys
/// that start with `spheretree_`; the tree's name is the grid's. Edges of the Sphere-DAG, where
/// there are any, travel as a second point grid named `<name>_dag`: one point an edge, at its
/// parent's center, with int32 attributes `parent`, `child`. Cuts (SphereCuts.h) travel as a point
/// grid named `<name>_cuts`: one point a node, with `pscale`, `id`, `parent`, `radius`, `cover_sq`
/// as above and int32 attributes `first`, `last`.
///
/// Each grid carries a checksum of all this (TreeChecksum.h), and a tree is read whole or refused.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <openvdb/points/PointDataGrid.h>
#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {

/// Version of the layout above, stored as `spheretree_format`.
constexpr int kPointsFormat = 1;

/// @brief The tree as a point grid, named settings.name. The grid is the same for any number of
/// threads.
/// @param interrupter  may be null, here and below; any call may throw Interrupted
/// @throw openvdb::ValueError if the tree is inconsistent, or a center is no multiple of the
///        unit of its tree (1/2, 1/16 or 1/1024 voxel), which alone are exact
openvdb::points::PointDataGrid::Ptr toPoints(
    const SphereTree& tree, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief The same grid, in about half the memory: the tree loses its nodes. Each of their arrays
/// (`spheres`, `ijk`, `radiusSq`) is freed as soon as the grid has it, and is empty afterwards.
/// Levels, settings, edges and cuts stay, but dagToPoints() and cutsToPoints() need the nodes: call
/// them before.
/// @throw openvdb::ValueError as above; the tree is then unchanged. After any other exception,
///        Interrupted included, it is lost, as its nodes are after success: of both use levels and description alone.
openvdb::points::PointDataGrid::Ptr releaseToPoints(
    SphereTree& tree, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief The tree's DAG edges as a point grid; null if it has none.
openvdb::points::PointDataGrid::Ptr dagToPoints(
    const SphereTree& tree, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief The tree's cuts as a point grid; null if it has none.
/// @throw openvdb::ValueError if the tree or its cuts are inconsistent
openvdb::points::PointDataGrid::Ptr cutsToPoints(
    const SphereTree& tree, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return whether a grid claims to be a sphere-tree. It has the key of the format, or it has a checksum, and that
///         key, or one of a companion's, is damaged: then fromPoints() refuses it.
bool isSphereTree(const openvdb::GridBase& grid);

/// @return the grid of a tree of no object: without points, of the tree's name and transform. It is no
///         sphere-tree for fromPoints(), and says of itself what it stands for.
openvdb::points::PointDataGrid::Ptr emptyTreeToPoints(const SphereTree& tree);

/// @return whether a grid is one that emptyTreeToPoints() has made.
bool isEmptyTree(const openvdb::GridBase& grid);

/// @return whether a grid claims to be what dagToPoints() makes of a tree of that name.
bool isDagOf(const openvdb::GridBase& grid, const std::string& treeName);

/// @return whether a grid claims to be what cutsToPoints() makes of a tree of that name.
bool isCutsOf(const openvdb::GridBase& grid, const std::string& treeName);

/// @return whether a grid of a tree carries a checksum, by which fromPoints() knows that all of it is
///         as it was written. Grids of version 0.1 do not.
bool hasChecksum(const openvdb::GridBase& grid);

/// @brief The tree that toPoints() was given: identical, but for `settings.memory`, which is not
/// stored, and a custom model, which cannot be (unknownModel() stands in its place).
/// @param points  a grid written by toPoints(), also after a round trip through a file
/// @param dag     the grid of dagToPoints(), or null: the tree read then has no edges and `hasDag` is
///                false; its settings still say what it was built with
/// @param cuts    the grid of cutsToPoints(), or null: likewise, of cuts and `hasCuts`
/// @throw openvdb::ValueError if @a points is no sphere-tree or a damaged one (an attribute missing
///        or of another type, ids not 0...n-1, a parent out of range or not on the next level up, a
///        level missing, a radius that is no number or negative ...); the message names the damage
/// @throw openvdb::IoError if a grid contradicts its checksum: any one bit that is not as it was
///        written, of what toPoints(), dagToPoints() and cutsToPoints() write. The message names the
///        attributes, edges, groups, metadata or transform. Names of grids, and attributes, groups and
///        metadata of others may come and go. Who moves a tree removes the metadata
///        `spheretree_checksum_transform` of its grids; radii are in world units, and stay.
/// @note Linear. Checksums, all threads: 64 bytes a node, 8 an edge, at 8 GB a second and thread
///       (3 where it was built without libdeflate): with the digest that the command verifies, some 6% of
///       the reading.
SphereTree fromPoints(const openvdb::points::PointDataGrid& points,
    const openvdb::points::PointDataGrid* dag = nullptr,
    const openvdb::points::PointDataGrid* cuts = nullptr,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
