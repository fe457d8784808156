// SPDX-License-Identifier: Apache-2.0
/// @file CoarseObject.h
/// @brief An object at the resolution that suits its spheres: a level of its OR-pyramid.
///
/// Few large spheres do not see single voxels: what they lose on a coarse level is about the coarse voxel
/// against their radius. Of the levels that have enough leaf balls for the spheres that are asked for, the
/// coarsest is taken. So its cost goes by the spheres, plus the pyramid.

#pragma once

#include "LeafBalls.h"
#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/pyramid/PyramidModel.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/tree/SphereTreeSettings.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

struct CoarseObject {
    /// Of the object, then of each level of the pyramid up to the one that is taken.
    std::vector<openvdb::MaskTree::ConstPtr> levels;
    std::vector<PyramidStep> steps; ///< from each level to the next
    SampledObject samples;          ///< of the last level
    LeafBalls leaves;               ///< of the last level
};

/// @param voxels     of the object
/// @param leastBalls the leaf balls that are enough; if no coarse level has as many, the object itself is
///                   taken
/// @param enough     voxels that are enough, however few leaf balls there are, as of an object like a ball
/// @param seconds    must not be null
/// @throw as MedialLevel
CoarseObject coarseObject(const openvdb::MaskTree::ConstPtr& voxels,
    const SphereTreeSettings& settings, int64_t leastBalls, int64_t enough,
    openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds);

} // namespace openvdb_spheretree::tight
