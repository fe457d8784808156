// SPDX-License-Identifier: Apache-2.0
/// @file ClusterCover.h
/// @brief A cover of the object from clusters of its voxels: a ball around each.

#pragma once

#include "Lloyd.h"
#include <openvdb_spheretree/sphere/ExactSphere.h>
#include <openvdb_spheretree/tight/fit/BallFit.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree::tight {

/// @param centers  every voxel belongs to the nearest
/// @param flat     centers keep their z
/// @return a ball for each center that has voxels: the cheapest that was found around these.
std::vector<ExactSphere> clusterCover(const std::vector<FineCenter>& centers,
    const SampledObject& object, const FitEffort& effort, bool flat,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::tight
