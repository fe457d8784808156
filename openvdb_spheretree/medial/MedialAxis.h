// SPDX-License-Identifier: Apache-2.0
/// @file MedialAxis.h
/// @brief The reduced discrete medial axis: the balls whose union is the object, none of them
/// without a voxel that it covers best.
///
/// The medial balls are the sites that label at least one voxel (CM07, section 4). Marks travel the
/// way labels are stored: along x from every object voxel, along y from what that marked, along z
/// from what that marked. Each pass writes only within its run, so runs are independent.
///
/// Exact. Cost: linear in active voxels. Tests: TestMedialAxis.cc.

#pragma once

#include "DistanceTransform.h"
#include "PowerMap.h"
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/MedialBall.h>

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

/// @return the medial balls, in the order of their centres (x first).
std::vector<MedialBall> medialBalls(const PowerMap& labels, const DistanceMap& distances,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief The same for people who come for just this: the medial balls of the active voxels of
/// @a object, centres in its index space.
std::vector<MedialBall> medialBalls(const openvdb::BoolGrid& object, int dim = 3,
    openvdb::util::NullInterrupter* interrupter = nullptr, const Distance& distance = {});

} // namespace openvdb_spheretree
