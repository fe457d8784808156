// SPDX-License-Identifier: Apache-2.0
/// @file CoverPart.h
/// @brief A part of a cover, copied, on which changes are tried before any is made.

#pragma once

#include "BallCover.h"
#include "CoverGoal.h"
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
    std::vector<int32_t> ids;        ///< ascending
    std::vector<CoverBall> balls;    ///< of these
    std::vector<uint64_t> placedFor; ///< BallCover::placedFor() of these
    FineBox box;                     ///< no change may reach out of it
    double change = 0;               ///< of the cover's cost, voxels

    /// @return the place of a ball in the lists.
    std::size_t indexOf(int32_t id) const;
};

/// The balls of a part that are not what they were.
struct CoverChange {
    std::vector<int32_t> ids;
    std::vector<CoverBall> balls;
    FineBox box; ///< of these balls, before and after
    /// Balls that were placed for other voxels than before, also where that did not change them, and
    /// the hashes of these voxels.
    std::vector<std::pair<int32_t, uint64_t>> placedFor;
    double change = std::numeric_limits<double>::infinity(); ///< of the cover's cost, voxels

    /// @return whether it lowers the cost.
    bool improves() const { return change < 0 && !ids.empty(); }
};

/// Places balls of a part anew. Reads the cover only, so many threads can try changes at a time.
class PartFit {
public:
    PartFit(const BallCover& cover, const SampledObject& object, const CoverGoal& goal,
        const SearchEffort& effort)
        : mCover(cover), mObject(object), mGoal(goal), mEffort(effort)
    {}

    const SearchEffort& effort() const { return mEffort; }

    /// @return the part that some balls are in, with all that is around them and room to grow.
    CoverPart around(const std::vector<int32_t>& ids) const;

    /// @return the voxels that only ball @a i holds: points as CoverGoal has them.
    std::vector<openvdb::Coord> uncoveredWithout(const CoverPart& part, std::size_t i) const;
    /// @return what ball @a i costs beside the others.
    double costOf(const CoverPart& part, std::size_t i) const;
    /// Puts a ball into the part that is not in the cover. @return its index.
    std::size_t insert(CoverPart& part, const CoverBall& ball) const;
    /// Puts another ball in the place of ball @a i, whatever it holds.
    void replace(CoverPart& part, std::size_t i, const ExactSphere& instead) const;

    /// Places ball @a i anew for the voxels that only it holds, if that costs less. A ball that was
    /// placed for the same voxels before is left alone: of those, one in a hundred would change.
    void refit(CoverPart& part, std::size_t i) const;
    /// Does that for those of the balls that touch @a ball.
    void refitNear(CoverPart& part, const std::vector<int32_t>& ids, const ExactSphere& ball) const;
    /// Places ball @a successor for the voxels that only it and ball @a i hold, and drops ball @a i.
    /// @return whether there were such voxels, and room.
    bool takeOver(CoverPart& part, std::size_t i, std::size_t successor) const;

    /// @return what has changed. Of two changes whose boxes do not meet, neither relies on balls of
    /// the other or shares their costs: both can be made.
    CoverChange changeOf(const CoverPart& part) const;

private:
    const BallCover& mCover;
    const SampledObject& mObject;
    const CoverGoal& mGoal;
    SearchEffort mEffort;
};

/// Makes a change.
/// @param slot  the number that a new ball gets
void apply(const CoverChange& change, BallCover& cover, int32_t slot = -1);

} // namespace tight
} // namespace openvdb_spheretree
