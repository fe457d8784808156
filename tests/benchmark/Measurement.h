// SPDX-License-Identifier: Apache-2.0
/// @file Measurement.h
/// @brief What is known of one stage of one object on one number of threads.

#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace spheretree_benchmark {

struct Measurement {
    static constexpr double kNotYet = std::numeric_limits<double>::infinity();

    std::string object, family, stage;
    int threads = 1;

    int64_t voxels = 0, leaves = 0;   ///< of the object
    int64_t balls = 0;                ///< that the stage began with, where its time goes by them
    int runs = 0;                     ///< of the stage
    double seconds = kNotYet;         ///< the best of all runs
    double copySeconds = kNotYet;     ///< the same of the plain copy beside it
    std::optional<int64_t> peakBytes; ///< beyond what was resident before; empty: not known
    std::string failure;              ///< why there are no times, if there are none

    bool measured() const { return failure.empty() && seconds < kNotYet; }
    double megavoxelsPerSecond() const { return 1e-6 * double(voxels) / seconds; }
    double ofCopy() const { return copySeconds / seconds; }
    std::optional<double> peakBytesPerVoxel() const
    {
        if (!peakBytes) return std::nullopt;
        return double(*peakBytes) / double(voxels);
    }
};

} // namespace spheretree_benchmark
