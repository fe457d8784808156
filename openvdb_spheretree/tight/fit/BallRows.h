// SPDX-License-Identifier: Apache-2.0
/// @file BallRows.h
/// @brief Counts, lists and clears the bits of a window that lie in a ball, row by row along z. The
/// ends of the ball are found for several rows at once.
///
/// A ball of squared radius r (in 1/16 sample) meets row (x, y) in the samples z with
/// (16 z - cz)^2 <= r - dx^2 - dy^2: floor of a square root, exact in floats since r <= 2^20.

#pragma once

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

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

/// Appends the bits in the ball, run by run; distances are to its center.
void collectBits(const BitRows& rows, const LocalBall& ball, std::vector<CostRun>& found);

/// Clears the bits in the ball. The bits are as in BitRows.
void clearBits(uint64_t* bits, const int32_t size[3], int32_t words, const LocalBall& ball);

} // namespace openvdb_spheretree::tight
