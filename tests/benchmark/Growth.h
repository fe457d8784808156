// SPDX-License-Identifier: Apache-2.0
/// @file Growth.h
/// @brief How the time of a stage grows with the size of objects of one family: the exponent e of
/// time ~ voxels^e, by least squares over the logarithms.

#pragma once

#include "Measurement.h"

#include <string>
#include <vector>

namespace spheretree_benchmark {

struct Growth {
    std::string family, stage;
    int threads = 1;
    double exponent = 0;
    int sizes = 0; ///< 2 or more
    int64_t smallestVoxels = 0, largestVoxels = 0;
};

/// @return one for each family, stage and number of threads of which two sizes or more have times,
/// in the order in which they first appear.
std::vector<Growth> growthOf(const std::vector<Measurement>& measurements);

} // namespace spheretree_benchmark
