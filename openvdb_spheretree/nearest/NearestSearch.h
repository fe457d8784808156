// SPDX-License-Identifier: Apache-2.0
/// @file NearestSearch.h
/// @brief N spheres nearest to an object, neither inside nor outside: with as little excess + missing as a
/// search finds.
///
/// 1. descend: each sphere climbs over its center and its radius, given the others (SphereSet.h).
/// 2. relocate: the inner spheres of what is still missing are added, all descend, and the spheres that are worth
///    least go until N are left. Where that hardly pays, fewer are tried next.
/// 3. descend once more, with four times the samples: what large spheres still gain.
///
/// What a step makes is counted in voxels, exactly, and dropped where it is not less: the result is never worse
/// than the start. Of dragon-128, 64 inner spheres have 26.8 % wrong, 16.4 after the first step, 15.3 at the end;
/// with all samples from the beginning that is no better, and takes three times as long for dragon-512.
///
/// Deterministic for any number of threads. Tests: TestNearestSearch.cc.

#pragma once

#include "NearestObject.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::nearest {

struct NearestSpheres {
    std::vector<ExactSphere> spheres; ///< 1/16 voxel
    int64_t wrong = 0;                ///< excess + missing, voxels
};

/// @param start  one sphere or more: inner ones do well
/// @return as many, at least as near.
/// @throw Interrupted if the interrupter of @a object (which may be null) said so
/// @note Cost: two thousand counts of a sphere and more for each, at two look-ups a row of 12 to 48 samples in a radius;
///       and some ten unions of all spheres.
NearestSpheres nearestFrom(const NearestObject& object, std::vector<ExactSphere> start);

} // namespace openvdb_spheretree::nearest
