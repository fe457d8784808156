// SPDX-License-Identifier: Apache-2.0
/// @file CoverRelocation.h
/// @brief Balls of a cover move elsewhere: one is removed, and a neighbour grows for the voxels that
/// only it held; a small one is inserted at another place, and its neighbours shrink.

#pragma once

#include "CoverPart.h"

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace tight {

class CoverRelocation {
public:
    /// @param finer  balls to be put in: smaller ones; together they cover, too. If there are none,
    ///               every ball stays where it is.
    CoverRelocation(BallCover& cover, const PartFit& fit, const std::vector<CoverBall>& finer,
        openvdb::util::NullInterrupter* interrupter)
        : mCover(cover), mFit(fit), mFiner(finer), mInterrupter(interrupter)
    {}

    /// Pairs the cheapest removals with the best of many insertions, as long as that lowers the cost.
    void relocate();
    /// Puts balls in where some were dropped, as long as that lowers the cost.
    void fill();
    /// @return what all that has done to the cover's cost, voxels.
    double change() const { return mChange; }

private:
    CoverChange removal(int32_t id) const;
    CoverBall newcomer(uint64_t number) const;
    CoverChange insertion(uint64_t number) const;
    std::vector<CoverChange> bestInsertions(std::size_t tries);
    void apply(const CoverChange& change, int32_t slot = -1);

    BallCover& mCover;
    const PartFit& mFit;
    const std::vector<CoverBall>& mFiner;
    openvdb::util::NullInterrupter* mInterrupter;
    uint64_t mInsertions = 0; ///< tried so far
    double mChange = 0;
};

} // namespace tight
} // namespace openvdb_spheretree
