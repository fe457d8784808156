// SPDX-License-Identifier: Apache-2.0
/// @file SphereClimb.h
/// @brief Moves one sphere to where it gains most, given all others: a pattern search over its center and
/// its radius.
///
/// 1. All neighbours at one step are tried: the center a step along any of the axes, the radius a
///    step more or less. The best is taken, of equals the first.
/// 2. Where none is better, the step is halved: from two samples to a quarter of one.
///
/// A sphere never gains less than before. Its window has a margin of a few samples, and what would leave
/// it is not tried: another visit goes on from there. Exact where a sphere's samples are voxels (GainWindow.h).

#pragma once

#include "GainWindow.h"

namespace openvdb_spheretree::nearest {

constexpr int64_t kLargestStep = 2 * tight::kFine,
                  kSmallestStep = tight::kFine / 4; ///< 1/16 sample
/// How far a sphere may reach beyond where it was, in samples.
constexpr int kMargin = 4;

/// @param window  with all other spheres covered, and their sums
/// @param sphere  local; becomes what was found
/// @param flat    its center stays in the plane
/// @return what it gains there.
int64_t climb(const GainWindow& window, LocalSphere& sphere, bool flat);

} // namespace openvdb_spheretree::nearest
