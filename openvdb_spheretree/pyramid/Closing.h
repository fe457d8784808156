// SPDX-License-Identifier: Apache-2.0
/// @file Closing.h
/// @brief Morphological closing of a set of voxels by a Euclidean ball, and the pyramid model that
/// closes a level before the OR.
///
/// The structuring element is the digital ball { q : |q|^2 <= r^2 } (with dim = 2 the disc in the
/// plane of x and y). Dilation adds every voxel within r of the set; erosion removes those that are
/// within r of a voxel that is still off (BallMorphology.h). So closing adds voxels, never removes one
/// of the set, and never leaves its box: a ball that touches a side of the box from outside holds no
/// voxel of the set.
///
/// Cost: linear in the voxels of a band around the surface, of 2 r and 16 voxels or less to each
/// side; tiles are cut up only within it. Parallel. Source: J. Serra, "Image Analysis and
/// Mathematical Morphology", 1982; Broutta et al. 2009, section 5, name such models as future work.
/// Tests: TestClosing.cc, against closing voxel by voxel.

#pragma once

#include "PyramidModel.h"
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {

/// The largest radius of a closing, in voxels.
constexpr int kMaxClosing = 64;

/// @throw openvdb::ValueError unless @a radius is 0 to kMaxClosing
void requireClosing(int radius);

/// @param radius  of the ball, in voxels: 0 (changes nothing) to kMaxClosing
/// @param dim     3, or 2 to close every plane of equal z by itself
/// @throw openvdb::ValueError if radius or dim is out of range
/// @throw Interrupted if the interrupter (may be null) said so
openvdb::MaskTree::Ptr closing(const openvdb::MaskTree& voxels, int radius, int dim = 3,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief OR after a closing at the child level: gaps narrower than the ball vanish earlier.
/// The interrupter (may be null) must live as long as the model.
PyramidModel closingModel(int radius, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
