// SPDX-License-Identifier: Apache-2.0
/// @file BallCover.h
/// @brief The balls of a level while they are searched: numbered, and found by place.

#pragma once

#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/merge/CoverBall.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace openvdb_spheretree::tight {

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

} // namespace openvdb_spheretree::tight
