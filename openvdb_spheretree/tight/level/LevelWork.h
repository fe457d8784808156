// SPDX-License-Identifier: Apache-2.0
/// @file LevelWork.h
/// @brief What the steps of making levels take, about: for progress, and for estimates before the
/// work.

#pragma once

#include "LevelMaker.h"
#include <openvdb_spheretree/tree/SphereTreeSettings.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// Seconds of one thread of a machine of 2023, for objects of 10^4 to 10^7 voxels: right within a
/// factor of three. That they are right compared with each other matters more.
class LevelWork {
public:
    explicit LevelWork(const LevelMaker& maker)
        : LevelWork(maker, maker.object.level(0).leafCount())
    {}
    /// @param leaves  leaf nodes of the object
    LevelWork(const LevelMaker& maker, std::size_t leaves) : mMaker(maker), mLeaves(double(leaves))
    {}

    /// @name Of the steps of a LevelMaker, and of FreeCovers
    /// @{
    /// @param few  of the dilated cover, about
    double ofDilating(int64_t balls, int64_t few) const;
    double ofMerging(int64_t balls, int64_t count) const;
    double ofPlacing(int64_t balls, bool isBetween = false) const;
    double ofSearch(int64_t balls) const;
    double ofMoves(int64_t children) const;
    /// @}

    /// @return the work for a cover of @a count balls that is bound to nothing, made from @a start
    /// (FreeCovers.h).
    double ofFreeCover(int64_t start, int64_t count) const;
    /// @return that for all searches of a level.
    double ofSearches(int64_t balls) const;
    /// @return that for the levels above a finest one (BottomUpLevels.h).
    double fromBottom(const std::vector<int64_t>& counts) const;
    /// @return that for one level of few balls (TopDownLevels.h).
    double fromTop(int64_t count, Quality quality) const;
    /// @return that for levels of named counts.
    /// @param finer  leaf nodes of each level of the pyramid that they are carried to
    ///               (CarriedLevels.h)
    double ofCounts(int64_t leafBalls, const std::vector<int64_t>& counts, Quality quality,
        const std::vector<int64_t>& finer) const;

private:
    const LevelMaker& mMaker;
    const double mLeaves;
};

} // namespace openvdb_spheretree::tight
