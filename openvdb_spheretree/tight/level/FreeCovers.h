// SPDX-License-Identifier: Apache-2.0
/// @file FreeCovers.h
/// @brief Covers of the object with ever fewer balls, each bound to no other one.
///
/// Of a start of many balls few are taken at once, dilated (DilatedCover.h) and fitted to their
/// power cells. Then, by turns, balls are merged and placed anew:
/// 1. Each ball has to hold its power cell, and neighbours are merged to about half as many
///    (MergeForest.h).
/// 2. Each ball of the new cover is placed anew for the voxels that it alone holds: twice on the
///    way, and until nothing changes where a cover is what was asked for.
///
/// A merge decides for two balls, and never again; what it decided wrongly, the second step mends.
/// So the next cells are those of a good cover. (dragon-128, 64 balls: 56 % of error, in place of
/// 68 where all is merged at once.)
///
/// Cost: by the balls of the start, and two passes or three over the voxels for each halving.

#pragma once

#include "LevelMaker.h"
#include <openvdb_spheretree/tight/fit/FineSphere.h>

#include <cstdint>
#include <map>
#include <vector>

namespace openvdb_spheretree::tight {

class FreeCovers {
public:
    /// @param start      a cover of the object
    /// @param areInside  its balls have no voxel outside the object
    FreeCovers(const std::vector<ExactSphere>& start, bool areInside, const LevelMaker& maker);

    /// @param count  1 or more
    /// @return a cover of at most so many balls, made from the next larger one that was asked for,
    /// or on the way to one. It stays valid.
    const std::vector<ExactSphere>& cover(int64_t count);

    /// @return at most @a count balls that are bound to no others, in the sense of CoverSearch.h if
    /// there is to be a search.
    std::vector<ExactSphere> searched(int64_t count);

    /// @return covers from the same start.
    /// @param maker  has to outlive them
    FreeCovers sameStart(const LevelMaker& maker) const
    {
        return {mCovers.at(mStart).balls, mAreInside, maker};
    }
    FreeCovers sameStart(LevelMaker&& maker) const = delete;
    std::size_t startSize() const { return std::size_t(mStart); }

    /// The next cover on the way.
    struct Next {
        int64_t count; ///< of its balls, at most
        bool isPlaced; ///< whether they are placed anew
        /// To about how many balls those of the start are dilated and pruned before; 0: they are
        /// not.
        int64_t dilated;
    };
    /// @param many     balls of the cover that is there, more than @a count
    /// @param isStart  whether that is the start
    static Next next(int64_t many, int64_t count, bool isStart, const LevelMaker& maker);

private:
    struct FittedBalls {
        std::vector<ExactSphere> balls;
        HeldPoints points; ///< extreme ones of the power cell that each is fitted to
    };
    /// @return the next cover after the start, not placed yet.
    std::vector<ExactSphere> mergedStart(const Next& next) const;
    /// @return of the start's balls some, dilated and fitted to power cells; none if all would be
    /// left.
    FittedBalls dilatedStart(const Next& next) const;
    /// @param isBetween  they will be merged further
    std::vector<ExactSphere> placed(const std::vector<ExactSphere>& balls, bool isBetween) const;

    struct Cover {
        std::vector<ExactSphere> balls;
        bool isBetween; ///< it was made on the way to another one
    };

    const LevelMaker& mMaker;
    const bool mAreInside;            ///< the balls of the start
    std::map<int64_t, Cover> mCovers; ///< by the most balls they may have
    int64_t mStart = 0;               ///< that of the start
};

} // namespace openvdb_spheretree::tight
