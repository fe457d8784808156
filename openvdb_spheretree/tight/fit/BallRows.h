// SPDX-License-Identifier: Apache-2.0
/// @file BallRows.h
/// @brief Counts, lists and clears the bits of a window that lie in a ball, row by row along z. Where
/// rows enter and leave the ball is found for several rows at once.

#pragma once

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace tight {

struct LocalBall;
struct CostRun;

/// Rows of `words` words; row (x, y) is number x * size[1] + y.
struct BitRows {
    const uint64_t* bits;
    int32_t size[3]; ///< samples
    int32_t words;
};

/// @return the bits in the ball, which may reach out of the window.
int64_t countBits(const BitRows& rows, const LocalBall& ball);

/// Appends these bits, run by run; distances are to the ball's centre.
void collectBits(const BitRows& rows, const LocalBall& ball, std::vector<CostRun>& found);

void clearBits(uint64_t* bits, const int32_t size[3], int32_t words, const LocalBall& ball);

} // namespace tight
} // namespace openvdb_spheretree
