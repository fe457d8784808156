// SPDX-License-Identifier: Apache-2.0
/// @file PyramidModel.h
/// @brief How the voxels of a level become those of the next one: the step, and models of it.
///
/// The OR model (OrPyramid.h) is the default. Any other one must be *including* (Broutta et al.
/// 2009, section 2.3): a parent of an on voxel is always on. Whoever uses a model verifies that.

#pragma once

#include <openvdb/openvdb.h>

#include <functional>

namespace openvdb_spheretree {

/// How voxels of one level become voxels of the next.
struct PyramidStep {
    openvdb::Coord origin; ///< of the finer level's cells: parent = floor((ijk - origin) / factor)
    int factor = 2;
    int dim = 3; ///< 2: z stays as it is

    openvdb::Coord parentVoxel(const openvdb::Coord& ijk) const;
};

/// Makes level k+1 of level k. Must be including: it has the OR model's voxels, maybe more.
using PyramidModel =
    std::function<openvdb::MaskTree::Ptr(const openvdb::MaskTree& level, const PyramidStep& step)>;

} // namespace openvdb_spheretree
