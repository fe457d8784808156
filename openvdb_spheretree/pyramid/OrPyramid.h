// SPDX-License-Identifier: Apache-2.0
/// @file OrPyramid.h
/// @brief The pyramid of volumes: a voxel of level k+1 is on when any of its factor^dim children on
/// level k is.
///
/// Level 0 lives in index space. Levels above have grids of their own, counted from `origin`, the
/// object's box minimum rounded down to a leaf corner: an object that straddles (0,0,0) then still
/// ends as one voxel.
///
/// From level to level, for any factor (`coarsen`):
/// 1. `collectParts`: each leaf, and each tile as large as a leaf, with the leaf of the next level
///    that it goes into, or the few that share it where the factor or the origin cuts leaves;
/// 2. `joinLeaves`: these by parent leaf, in parallel, on mask words (LeafCoarsener.h);
/// 3. `joinTiles`: larger tiles as boxes; a cube that tiles of its size fill is a tile again.
///
/// Other models plug in as a function (PyramidModel.h). Exact. Cost: linear in leaves and tiles,
/// whatever the bounding box. Source: Broutta et al. 2009, section 2.3. Tests: TestOrPyramid.cc,
/// TestPyramidFactors.cc.

#pragma once

#include "PyramidModel.h"
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <optional>
#include <vector>

namespace openvdb_spheretree {

/// A side of the object's box may have this many voxels, so that squares of distances fit 64 bits.
constexpr int kMaxExtentBits = 28;
constexpr int64_t kMaxExtent = int64_t(1) << kMaxExtentBits;

/// @brief The OR model. Parallel; the result has no full node that could be a tile.
openvdb::MaskTree::Ptr coarsen(const openvdb::MaskTree& level, const PyramidStep& step,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief The level above @a level by @a model; empty: the OR model.
/// @throw openvdb::ValueError naming the number of lost voxels and the first, if the model is not
///        including; or if it adds voxels along z with dim = 2
openvdb::MaskTree::Ptr nextLevel(const openvdb::MaskTree& level, const PyramidStep& step,
    const PyramidModel& model, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return a box's minimum rounded down to a multiple of 8 per axis.
/// @throw openvdb::ValueError if a side of the box exceeds kMaxExtent
openvdb::Coord pyramidOrigin(const openvdb::CoordBBox& bbox);

/// @return @a wanted, for a pyramid of an object with this box. Along @a flatAxis, if there is one,
///         levels do not coarsen, and the origin is that of the box.
/// @throw openvdb::ValueError if it is above the box's minimum along an axis: voxels on both sides of
///        the origin would never be one; or if the box reaches farther than kMaxExtent from it
openvdb::Coord pyramidOrigin(
    const openvdb::CoordBBox& bbox, const openvdb::Coord& wanted, std::optional<int> flatAxis);

struct OrPyramid {
    openvdb::Coord origin;
    std::vector<openvdb::MaskTree::Ptr> levels; ///< level 0 first; the last one is a single voxel
};

/// @brief All levels, from the active voxels of @a object to a single voxel.
/// @param model  empty: the OR model
/// @throw openvdb::ValueError if the object is empty or too wide, factor or dim are out of range,
///        the model is not including, or the pyramid does not end at one voxel
/// @throw Interrupted if the interrupter (may be null) said so
OrPyramid buildOrPyramid(const openvdb::BoolGrid& object, int factor = 2, int dim = 3,
    const PyramidModel& model = {}, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
