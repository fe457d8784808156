// SPDX-License-Identifier: Apache-2.0
/// @file CoverGoal.h
/// @brief What a cover has to hold, and so which voxels would be uncovered without some of its
/// balls.
///
/// A cover is of voxels, or of units. A unit is a set of voxels that one ball has to hold as a
/// whole: the power cell of a ball of the next finer level, which becomes a child of the ball that
/// holds it.

#pragma once

#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/tight/merge/CoverBall.h>
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include <openvdb/Types.h>

#include <utility>
#include <vector>

namespace openvdb_spheretree::tight {

class CoverGoal {
public:
    virtual ~CoverGoal() = default;
    /// @param removed  balls taken out of the cover
    /// @param others   at least all other balls that meet one of them; empty balls hold nothing
    /// @param points   receives extreme points of the voxels that only the removed balls hold: a
    ///                 ball that holds the points holds these voxels
    virtual void collectUncovered(const std::vector<CoverBall>& removed,
        const std::vector<CoverBall>& others, std::vector<openvdb::Coord>& points) const = 0;
};

class VoxelGoal : public CoverGoal {
public:
    /// @param regions  of the groups: a ball counts in its group's region only; without regions it
    ///                 counts in all of the object
    explicit VoxelGoal(const SampleLevel& object, std::vector<const VoxelRegion*> regions = {})
        : mObject(object), mRegions(std::move(regions))
    {}
    VoxelGoal(const SampleLevel& object, const std::vector<VoxelRegion>& regions) : mObject(object)
    {
        for (const VoxelRegion& region : regions) mRegions.push_back(&region);
    }
    void collectUncovered(const std::vector<CoverBall>& removed,
        const std::vector<CoverBall>& others, std::vector<openvdb::Coord>& points) const override;

    /// @return the voxels of a leaf that count where a ball of the group holds them.
    const LeafMask& counting(std::size_t leaf, int32_t group) const;

private:
    const SampleLevel& mObject;
    std::vector<const VoxelRegion*> mRegions;
};

class UnitGoal : public CoverGoal {
public:
    /// @param units  extreme points of each; a ball counts whatever its group
    explicit UnitGoal(const std::vector<std::vector<openvdb::Coord>>& units);
    void collectUncovered(const std::vector<CoverBall>& removed,
        const std::vector<CoverBall>& others, std::vector<openvdb::Coord>& points) const override;

private:
    const std::vector<std::vector<openvdb::Coord>>& mUnits;
    BallGrid mGrid; ///< of balls around units
};

/// @return whether @a ball holds all the points.
bool holdsAll(const ExactSphere& ball, const std::vector<openvdb::Coord>& points);

} // namespace openvdb_spheretree::tight
