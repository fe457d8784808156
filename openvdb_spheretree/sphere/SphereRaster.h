// SPDX-License-Identifier: Apache-2.0
/// @file SphereRaster.h
/// @brief The rasteriser behind sphereUnion(); it can also be confined to the nodes of an object.

#pragma once

#include "SphereUnion.h"
#include <openvdb_spheretree/voxel/Masks.h>

namespace openvdb_spheretree::detail {

/// @brief Every voxel of @a clip that lies in a sphere.
/// @param within  may be null; else nodes where it has nothing are left out. (Voxels that it does
///                not have may still be in the result.) Makes coverage of a sparse object cheap
///                to check, however large the spheres.
openvdb::MaskTree::Ptr rasterSpheres(const std::vector<ExactSphere>& spheres,
    const SphereMetric& metric, const openvdb::CoordBBox& clip, const openvdb::MaskTree* within,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
