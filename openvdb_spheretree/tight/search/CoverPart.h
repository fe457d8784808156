// SPDX-License-Identifier: Apache-2.0
/// @file CoverPart.h
/// @brief The cover that is searched, and a copy of a part of it, to try changes on before one is
/// made.

#pragma once

#include "CoverGoal.h"
#include <openvdb_spheretree/tight/fit/BallFit.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace openvdb_spheretree::tight {

/// The balls of a level while they are searched: numbered, and found by place.
class BallCover {
public:
    explicit BallCover(std::vector<CoverBall> balls)
        : mBalls(std::move(balls)), mPlacedFor(mBalls.size(), 0), mGrid(ballsOf(mBalls))
    {}

    std::size_t size() const { return mBalls.size(); }
    /// @return the ball of a number; an empty one if it was dropped.
    const CoverBall& operator[](int32_t id) const { return mBalls[id]; }
    const std::vector<CoverBall>& balls() const { return mBalls; }

    /// @return a hash of the voxels for which a ball was placed last; 0 if it never was.
    uint64_t placedFor(int32_t id) const { return mPlacedFor[id]; }

    /// @return the balls that are not empty, by place.
    const BallGrid& grid() const { return mGrid; }

    void put(int32_t id, const CoverBall& ball)
    {
        if (!mBalls[id].empty()) mGrid.remove(id, mBalls[id].ball);
        mBalls[id] = ball;
        if (!ball.empty()) mGrid.add(id, ball.ball);
    }
    void setPlacedFor(int32_t id, uint64_t hash) { mPlacedFor[id] = hash; }

private:
    std::vector<CoverBall> mBalls;
    std::vector<uint64_t> mPlacedFor;
    BallGrid mGrid;
};

/// So many sweeps of placing balls anew are few: most of the gain.
constexpr int kFewSweeps = 2;

struct SearchEffort {
    FitEffort fit;
    int trialsPerBall = 20;
    uint64_t seed = 0; ///< of the random changes
    bool flat = false;
    std::size_t relocations = 6; ///< how often in a search balls move elsewhere; at least 1
    int sweeps = 10;             ///< how often balls are placed anew in turn, at most
};

/// The number of a ball that is in a part, but not yet in the cover.
constexpr int32_t kNewBall = std::numeric_limits<int32_t>::max();
/// When a ball changes, at most so many of its neighbours are placed anew.
constexpr std::size_t kChangedNeighbours = 10;

struct CoverPart {
    std::vector<int32_t> ids;        ///< ascending
    std::vector<CoverBall> balls;    ///< with these numbers
    std::vector<uint64_t> placedFor; ///< BallCover::placedFor() of each
    FineBox box;                     ///< no change may reach out of it
    double change = 0;               ///< of the cover's cost, voxels

    /// @return the place of a ball in the lists.
    std::size_t indexOf(int32_t id) const;
    /// @return the other balls, beside @a id, whose boxes meet a box that does not reach out of the
    /// part.
    std::vector<int32_t> meeting(const FineBox& some, int32_t id) const;
};

/// The balls of a part that are not what they were.
struct CoverChange {
    std::vector<int32_t> ids;
    std::vector<CoverBall> balls;
    FineBox box; ///< of these balls, before and after
    /// Balls that were placed for other voxels than before, changed or not, and the hashes of these
    /// voxels.
    std::vector<std::pair<int32_t, uint64_t>> placedFor;
    double change = std::numeric_limits<double>::infinity(); ///< of the cover's cost, voxels

    /// @return whether it lowers the cost.
    bool improves() const { return change < 0 && !ids.empty(); }
};

/// Places balls of a part anew. It only reads the cover, so many threads can try changes at a time.
class PartFit {
public:
    PartFit(const BallCover& cover, const SampledObject& object, const CoverGoal& goal,
        const SearchEffort& effort)
        : mCover(cover), mObject(object), mGoal(goal), mEffort(effort)
    {}

    const SearchEffort& effort() const { return mEffort; }

    /// @return the part around some balls: these, all balls near them, and room to grow.
    CoverPart around(const std::vector<int32_t>& ids) const;

    /// @return the voxels that only ball @a i holds: extreme points as of CoverGoal.
    std::vector<openvdb::Coord> uncoveredWithout(const CoverPart& part, std::size_t i) const;
    /// @return what ball @a i costs beside the others.
    double costOf(const CoverPart& part, std::size_t i) const;
    /// Adds a new ball to the part. @return its index.
    std::size_t insert(CoverPart& part, const CoverBall& ball) const;
    /// Puts another ball in the place of ball @a i, whether it holds the voxels or not.
    /// @return what ball @a i has cost.
    double replace(CoverPart& part, std::size_t i, const ExactSphere& instead) const;

    /// Places ball @a i anew for the voxels that only it holds, if that costs less. A ball that was
    /// last placed for the same voxels is left alone: one in a hundred of those would change.
    void refit(CoverPart& part, std::size_t i) const;
    /// Does that for those of the balls @a ids that touch @a ball.
    void refitNear(CoverPart& part, const std::vector<int32_t>& ids, const ExactSphere& ball) const;
    /// Places ball @a successor for the voxels that only it and ball @a i hold, and drops ball @a
    /// i.
    /// @return whether there were such voxels, and room.
    bool takeOver(CoverPart& part, std::size_t i, std::size_t successor) const;

    /// @return what has changed. If the boxes of two changes do not meet, both can be made: neither
    /// relies on balls of the other, and they share no costs.
    CoverChange changeOf(const CoverPart& part) const;

private:
    /// @return a fit for ball @a i: targets and replaced balls are as of CoveringFit::open(), and
    /// what the other balls of the part hold costs nothing.
    template <typename Targets>
    class CoveringFit& fitFor(const CoverPart& part, std::size_t i, const Targets& targets,
        const std::vector<ExactSphere>& replaced) const;

    const BallCover& mCover;
    const SampledObject& mObject;
    const CoverGoal& mGoal;
    SearchEffort mEffort;
};

/// Makes a change in the cover.
/// @param slot  the number that a new ball gets
void apply(const CoverChange& change, BallCover& cover, int32_t slot = -1);

} // namespace openvdb_spheretree::tight
