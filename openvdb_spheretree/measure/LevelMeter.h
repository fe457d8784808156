// SPDX-License-Identifier: Apache-2.0
/// @file LevelMeter.h
/// @brief Holds levels of spheres against one object: what computeLevelErrors() does level by
/// level, and what a search for the fewest spheres within a bound asks for.

#pragma once

#include <openvdb_spheretree/index/NearestVoxel.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree::detail {

class LevelMeter {
public:
    LevelMeter(const openvdb::BoolGrid& object, const Distance& distance);

    /// Fills in all errors of a level, or why they are unknown. Reasons are said without numbers of
    /// the level, so that levels have them in common.
    /// @throw what computeLevelErrors() throws
    void measure(const SphereTree& tree, SphereTreeLevel& level,
        openvdb::util::NullInterrupter* interrupter) const;

    /// Fills in `error` alone, or why it is unknown.
    void measureExact(const SphereTree& tree, SphereTreeLevel& level,
        openvdb::util::NullInterrupter* interrupter) const;

    /// Which of the two figures of stored spheres are wanted; the other one is left 0.
    struct StoredFigures {
        bool hamming = true, reach = true;
    };
    /// Fills in `stored` alone, or why it is unknown. The tree must have its stored radii.
    void measureStored(const SphereTree& tree, SphereTreeLevel& level, const StoredFigures& wanted,
        openvdb::util::NullInterrupter* interrupter) const;

private:
    /// @return a bound for points in the cubes of these voxels, in voxels.
    double reachOfVoxels(
        const MaskMinus& outside, openvdb::util::NullInterrupter* interrupter) const;

    openvdb::MaskTree mMask;
    NearestVoxel mNearest;
    int64_t mVoxels;
};

} // namespace openvdb_spheretree::detail
