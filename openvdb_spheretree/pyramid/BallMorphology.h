// SPDX-License-Identifier: Apache-2.0
/// @file BallMorphology.h
/// @brief Dilation and erosion of a sparse set of voxels by a Euclidean ball.
///
/// The structuring element is the digital ball { q : |q|^2 <= r^2 } (with dim = 2 the disc in the plane of x
/// and y). Dilation adds every voxel within r of the set; erosion removes those that are within r of a voxel
/// that is off. Both look for the voxels within r of another set, and the distance transform of a band of
/// voxels along it finds them, exactly:
/// 1. `leafCubesOf`, `grown`: the cubes of 8^3 voxels, aligned like leaves, within reach of the set;
/// 2. dilation: off voxels there whose distance to the set is r at most;
/// 3. erosion: voxels there go whose distance to the rest is r at most.
///
/// Cost: linear in the voxels of a band around the surface, of 2 r and 16 voxels or less to each side; tiles
/// are cut up only within it. Parallel. Source: J. Serra, "Image Analysis and Mathematical Morphology", 1982.
/// Tests: TestClosing.cc, against closing voxel by voxel.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree::detail {

/// @return the off voxels at most @a radius away from one of @a set.
/// @param what  for the message if there is no memory for them: what has them looked for
/// @throw openvdb::ValueError if the band takes more memory than there is; Interrupted
openvdb::MaskTree::Ptr voxelsNear(const openvdb::MaskTree& set, int radius, int dim,
    const char* what, openvdb::util::NullInterrupter* interrupter);

/// @brief Erode @a set by a ball, where that takes away voxels in the leaf cubes of @a around only: they are
/// all that need be looked at.
void erodeAround(openvdb::MaskTree& set, const openvdb::MaskTree& around, int radius, int dim,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
