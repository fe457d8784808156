// SPDX-License-Identifier: Apache-2.0
/// @file CoverPart.h
/// @brief A part of a cover, copied, on which changes are tried before any is made.

#pragma once

#include "BallCover.h"
#include "CoverDebt.h"
#include <openvdb_spheretree/tight/fit/BallFit.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace openvdb_spheretree {
namespace tight {

struct SearchEffort {
    FitEffort fit;
    int trialsPerBall = 20;
    uint64_t seed = 0; ///< of what is tried
    bool flat = false;
};

/// The number of a ball that is in a part and not yet in the cover.
constexpr int32_t kNewBall = std::numeric_limits<int32_t>::max();
/// A change of a ball looks at so many of its neighbours.
constexpr std::size_t kChangedNeighbours = 10;

struct CoverPart {
    std::vector<int32_t> ids;     ///< ascending
    std::vector<CoverBall> balls; ///< of these
    /// Hashes of the debts for which they were placed: BallCover.
    std::vector<uint64_t> placedFor;
    FineBox box;       ///< no change may reach out of it
    double change = 0; ///< of the cover's cost, voxels

    std::size_t indexOf(int32_t id) const;
};

/// What is left of a part: the balls that are not what they were.
struct CoverChange {
    std::vector<int32_t> ids;
    std::vector<CoverBall> balls;
    FineBox box; ///< of these balls, before and after
    /// Balls that were placed, for another debt than before, and hashes of these; also balls that
    /// stayed as they were.
    std::vector<std::pair<int32_t, uint64_t>> placedFor;
    double change = std::numeric_limits<double>::infinity(); ///< of the cover's cost, voxels

    bool pays() const { return change < 0 && !ids.empty(); }
};

/// @return whether two boxes share a point.
bool meet(const FineBox& a, const FineBox& b);
bool meetsAny(const FineBox& box, const std::vector<FineBox>& boxes);

/// Places balls of a part anew. Reads the cover only, so many threads can try changes at a time.
class PartFit {
public:
    PartFit(const BallCover& cover, const SampledObject& object, const CoverDebt& debt,
        const SearchEffort& effort)
        : mCover(cover), mObject(object), mDebt(debt), mEffort(effort)
    {}

    const SearchEffort& effort() const { return mEffort; }

    /// @return the part that some balls and what is around them are in; room for them to grow.
    CoverPart around(const std::vector<int32_t>& ids) const;
    static bool inside(const FineBall& ball, const FineBox& box);

    /// @return what ball @a i owes: points as CoverDebt has them.
    std::vector<openvdb::Coord> debtOf(const CoverPart& part, std::size_t i) const;
    /// @return what ball @a i costs beside the others.
    double costOf(const CoverPart& part, std::size_t i) const;
    /// Puts a ball into the part that is not in the cover. @return its index.
    std::size_t insert(CoverPart& part, const CoverBall& ball) const;
    /// Puts another ball in the place of ball @a i, whatever it holds.
    void replace(CoverPart& part, std::size_t i, const FineBall& instead) const;

    /// Places ball @a i anew for what it alone owes, if that costs less. A ball that was placed for
    /// the same debt before is left alone: of those, one in a hundred would change.
    void refit(CoverPart& part, std::size_t i) const;
    /// Does that for those of the balls that touch @a ball.
    void refitNear(CoverPart& part, const std::vector<int32_t>& ids, const FineBall& ball) const;
    /// Places ball @a heir for what it and ball @a i owe; that one is gone.
    /// @return whether there was a debt, and room.
    bool takeOver(CoverPart& part, std::size_t i, std::size_t heir) const;

    /// @return what has changed. Another change whose box does not meet this one's neither relies on
    /// these balls nor shares their costs: both can be made.
    CoverChange changeOf(const CoverPart& part) const;

private:
    const BallCover& mCover;
    const SampledObject& mObject;
    const CoverDebt& mDebt;
    SearchEffort mEffort;
};

/// Makes a change.
/// @param slot  the number that a new ball gets
void apply(const CoverChange& change, BallCover& cover, int32_t slot = -1);

} // namespace tight
} // namespace openvdb_spheretree
