// SPDX-License-Identifier: Apache-2.0
/// @file MedialAxis.h
/// @brief The reduced discrete medial axis: the balls whose union is the object, none of them
/// without a voxel that it covers best.
///
/// The medial balls are the sites that label at least one voxel (D. Coeurjolly and A. Montanvert,
/// IEEE PAMI 2007, section 4; RDMA in papers). This file is the public call. A ball is found where a
/// label leads to: for the Euclidean distance by ColumnPower::run() along x (slab/ColumnPower.h), then
/// SlabBalls::collect() along y and z (slab/SlabBalls.h), always slab by slab; for norms by ownLabels()
/// in MedialLevel.cc. How many bits that takes is counted in kernel/MaxPlus.h and kernel/MaxPlus.cc.
///
/// Exact. Cost: linear in active voxels, times log of the radius. Tests: TestMedialAxis.cc.

#pragma once

#include <openvdb_spheretree/voxel/Distance.h>
#include <openvdb_spheretree/voxel/MedialBall.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree {

/// @param object       its active voxels are the object
/// @param dim          3, or 2 to leave the flat axis out
/// @param interrupter  may be null
/// @return the medial balls, in the order of their centers (x first); centers in the index space of
///         @a object.
/// @throw openvdb::ValueError if a radius exceeds 32767 voxels, or there is too little memory
/// @throw Interrupted if the interrupter said so
std::vector<MedialBall> medialBalls(const openvdb::BoolGrid& object, int dim = 3,
    const Distance& distance = {}, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
