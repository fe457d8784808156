// SPDX-License-Identifier: Apache-2.0
/// @file SphereDag.h
/// @brief The Sphere-DAG between two consecutive levels: which balls share voxels with which.
///
/// t -> s when some voxel v of the finer level has label s and its parent voxel has label t
/// (Broutta et al. 2009, 3.1, Definition 2 and Algorithm 1): one scan of the voxels. Every edge is
/// witnessed by a voxel, and every voxel whose parent is on witnesses an edge. Exact. Cost: linear
/// in the finer level's voxels, and sorting the edges. Tests: TestSphereDag.cc.

#pragma once

#include "MedialLevel.h"
#include "OrPyramid.h"
#include "SphereTree.h"

#include <vector>

namespace openvdb_spheretree {

/// @brief The edges from the balls of @a coarse to the balls of @a fine, by index in `balls`,
/// sorted and unique.
/// @param step  how voxels of the finer level become voxels of the coarser one; voxels whose parent
///              voxel is off (possible between levels of an extended tree) have no part
std::vector<DagEdge> sphereDag(const MedialLevel& fine, const MedialLevel& coarse,
    const PyramidStep& step, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
