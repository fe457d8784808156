// SPDX-License-Identifier: Apache-2.0
/// @file StageSeconds.h
/// @brief How long the stages of a build took.

#pragma once

namespace openvdb_spheretree {

/// Seconds spent in the stages of a build, summed over levels.
struct StageSeconds {
    double pyramid = 0, distance = 0, power = 0, medial = 0, tree = 0, topology = 0;
};

} // namespace openvdb_spheretree
