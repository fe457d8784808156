// SPDX-License-Identifier: Apache-2.0
/// @file CoverRelocation.h
/// @brief Balls of a cover move elsewhere. One is removed, and a neighbour grows to hold the voxels
/// that only it held. A small one is inserted at another place, and its neighbours shrink.

#pragma once

#include "CoverPart.h"

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

class CoverRelocation {
public:
    /// @param finer  smaller balls to insert, which are a cover, too. If there are none, every ball
    ///               stays where it is.
    CoverRelocation(BallCover& cover, const PartFit& fit, const std::vector<CoverBall>& finer,
        openvdb::util::NullInterrupter* interrupter)
        : mCover(cover), mFit(fit), mFiner(finer), mInterrupter(interrupter)
    {}

    /// Pairs the cheapest removals with the best of many insertions, as long as that lowers the
    /// cost.
    void relocate();
    /// Inserts balls in place of dropped ones, as long as that lowers the cost.
    void fill();
    /// @return how the cover's cost has changed by all that, voxels.
    double change() const { return mChange; }

private:
    /// A neighbour of its group takes over the voxels that only ball @a id holds: the one for which
    /// that costs least.
    CoverChange removal(int32_t id) const;
    /// A small ball is put in, and its neighbours shrink.
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

} // namespace openvdb_spheretree::tight
