// SPDX-License-Identifier: Apache-2.0
/// @file PyramidModel.h
/// @brief How the voxels of a level become those of the next one: the step, and models of it.
///
/// The OR model (OrPyramid.h) is the default. Any other model must be *including* (Broutta et al.
/// 2009, section 2.3): the parent of an on voxel is on. nextLevel() in OrPyramid.h verifies that.
/// - OR after a closing: the setting `closing`, or closingModel() in Closing.h;
/// - a function of the children of a voxel and of the voxels around these children: blockModel() in
///   BlockModel.h;
/// - any function from the mask of a level to that of the next: a PyramidModel.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <functional>

namespace openvdb_spheretree {

/// Voxels merged per axis from level to level: 2 to this.
constexpr int kMaxFactor = 1 << 15;

/// @throw openvdb::ValueError unless @a factor is 2 to kMaxFactor
void requireFactor(int factor);

/// How voxels of one level become voxels of the next.
struct PyramidStep {
    openvdb::Coord origin; ///< of the finer level: parent = floor((ijk - origin) / factor)
    int factor = 2;
    int dim = 3; ///< 2: z stays as it is

    openvdb::Coord parentVoxel(const openvdb::Coord& ijk) const;
};

/// Makes level k+1 of level k. Must be including: it has the OR model's voxels, maybe more, with
/// dim = 2 in the same planes. It should shrink what it is given: levels end where one ball is
/// left, and a model that keeps adding voxels is stopped by an error.
using PyramidModel =
    std::function<openvdb::MaskTree::Ptr(const openvdb::MaskTree& level, const PyramidStep& step)>;

} // namespace openvdb_spheretree
