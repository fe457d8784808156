// SPDX-License-Identifier: Apache-2.0
/// @file CostRuns.h
/// @brief Counts the samples that cost in balls near one place, from a list of runs.
///
/// A run is consecutive samples along z. How many of its samples are in a ball follows from one
/// square root, for several runs at once. The runs nearest to the place come first: a ball is
/// likely to hold these, so one that is worse than the best so far is given up early. (Counting
/// rows of bits, BallRows.h, takes a square root for each row of the ball, though most rows have
/// nothing to count. A tight tree took three times as long.)

#pragma once

#include "CostWindow.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

constexpr std::size_t kRunsAtOnce = 32; // a multiple of the lanes of every target

/// What the kernel reads of a list of runs.
struct RunArrays {
    const float *x, *y;
    const int32_t *first, *last;
};

class CostRuns {
public:
    /// Takes the samples of @a window that lie in @a place, a ball that may reach out of it.
    void collect(const CostWindow& window, const LocalBall& place);

    /// @return whether the ball lies in the place, so that it can be counted.
    bool fits(const LocalBall& ball) const { return reachSq(ball) <= mPlace.radiusSq; }
    /// @return the samples in a ball that fits. If they are more than @a bound: any number above
    /// it.
    int64_t count(const LocalBall& ball, int64_t bound = INT64_MAX) const;

private:
    static constexpr int kShells = 64; ///< of equal squared width
    /// @return the square of how far a ball reaches from the middle of the place.
    float reachSq(const LocalBall& ball) const;
    int shellOf(float distanceSq) const
    {
        return std::min(kShells - 1, int(distanceSq * mShellsPerSq));
    }

    LocalBall mPlace;
    float mShellsPerSq = 0;
    std::array<uint32_t, kShells + 1> mShellBegin; ///< in the arrays
    std::vector<float> mX, mY;                     ///< of the rows
    std::vector<int32_t> mFirst, mLast;            ///< samples
    std::vector<CostRun> mFound;                   ///< before they are sorted
};

} // namespace openvdb_spheretree::tight
