// SPDX-License-Identifier: Apache-2.0
/// @file TightEstimate.h
/// @brief What the levels of a tight tree are going to take, before they are made.

#pragma once

#include <openvdb_spheretree/tree/SphereTreeSettings.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree::tight {

/// Guessed from the leaf balls of a coarse level of the pyramid, of which each finer level has
/// about 3.5 times as many: medial axes of solids are sheets. Sheets have 4 times as many. Right
/// within a factor of three.
struct TightEstimate {
    double leafBalls = 0;  ///< that levels are made from
    double seconds = 0;    ///< of one processor
    double bytes = 0;      ///< beside the object, its labels and the tree
    double leastBytes = 0; ///< of them, those that have to be allowed whatever the leaf balls are
    openvdb::MaskTree::ConstPtr labelled; ///< the level of the pyramid that they are made on
};

/// @param voxels  flat objects are flat along z
/// @note Cost: the pyramid, and the leaf balls of coarse levels of up to some million voxels, which
/// take no heed of SphereTreeSettings::memory.
TightEstimate estimateTightTree(const openvdb::MaskTree::ConstPtr& voxels,
    const SphereTreeSettings& settings, openvdb::util::NullInterrupter* interrupter);

/// @param settings  whose memory is too little
/// @param atLeast   bytes that are known to be needed
/// @throw detail::MemoryError with what the tree needs at its peak, about: that of its labels, or
/// of its levels
[[noreturn]] void refuseTightTree(
    const TightEstimate& estimate, const SphereTreeSettings& settings, double atLeast);

} // namespace openvdb_spheretree::tight
