// SPDX-License-Identifier: Apache-2.0
/// @file CoarseObject.h
/// @brief An object at the resolution that suits its spheres: a level of its OR-pyramid.
///
/// Few large spheres do not see single voxels: what they lose on a coarse level is about the coarse
/// voxel against their radius. Of the levels that have enough leaf balls for the spheres that are
/// asked for, the coarsest is taken. So its cost goes by the spheres, plus the pyramid.

#pragma once

#include "LeafBalls.h"
#include "WorkingMemory.h"
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

    /// @return how many leaf nodes each level below @a level has, tiles included; finest first.
    std::vector<int64_t> leafNodesBelow(std::size_t level) const;
};

/// How large a level of the pyramid has to be: as many leaf balls, or as many voxels, as of an
/// object like a ball.
struct CoarseSize {
    int64_t leafBalls = INT64_MAX, voxels = INT64_MAX;
};

/// @return the size that levels of named counts need; for all others, that of no coarse level.
CoarseSize sizeFor(const TightOptions& options);

/// @return what a tree has to be allowed whatever its leaf balls are: samples of the object, and
/// what is enough for regions of named counts, which are all there at a time where levels are
/// carried down.
/// @param settings   of a tight tree
/// @param leafNodes  of the object
WorkingMemory leastAllowed(const SphereTreeSettings& settings, std::size_t leafNodes);

/// @param allLeaves  whether the leaf balls are a level of the tree
/// @return whether the voxels of each leaf ball are needed all at once.
bool makesLeafRegions(const TightOptions& options, bool allLeaves);

/// @param voxels     of the object
/// @param size       that is enough; if no coarse level has it, the object itself is taken
/// @param seconds    must not be null
/// @throw as MedialLevel
CoarseObject coarseObject(const openvdb::MaskTree::ConstPtr& voxels,
    const SphereTreeSettings& settings, const CoarseSize& size,
    openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds);

} // namespace openvdb_spheretree::tight
