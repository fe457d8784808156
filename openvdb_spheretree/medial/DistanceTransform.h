// SPDX-License-Identifier: Apache-2.0
/// @file DistanceTransform.h
/// @brief Exact distance of every object voxel to the nearest background voxel: Euclidean, squared,
/// or by a norm of the 3x3x3 neighbourhood (Distance.h).
///
/// The separable transform of D. Coeurjolly and A. Montanvert, "Optimal separable algorithms to
/// compute the reverse Euclidean distance transformation and discrete medial axis in arbitrary
/// dimension" (IEEE PAMI 2007), restricted to the object: no background voxel is stored or visited.
///
/// Exact, integer. Cost: linear in active voxels times log of the radius, whatever the bounding box.
/// Tests: TestDistanceTransform.cc, against all background voxels one by one.

#pragma once

#include <openvdb_spheretree/voxel/Distance.h>

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {

/// @param object       its active voxels are the object
/// @param dim          3, or 2 to leave the flat axis out
/// @param distance     Euclidean, or a norm
/// @param interrupter  may be null
/// @return for every active voxel its distance to the nearest inactive one, squared if Euclidean, in
///         units of the distance (Distance::unit()) if of a norm; background 0, transform of @a object.
/// @throw openvdb::ValueError if a radius is 46340 voxels (units of a norm) or more: 32 bits do not
///        hold its square
/// @throw Interrupted if the interrupter said so
openvdb::Int32Grid::Ptr distanceTransform(const openvdb::BoolGrid& object, int dim = 3,
    const Distance& distance = {}, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
