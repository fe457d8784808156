// SPDX-License-Identifier: Apache-2.0
#include "SphereClimb.h"

#include <openvdb_spheretree/base/IntegerRoot.h>

#include <cmath>

namespace openvdb_spheretree::nearest {

namespace {

/// Tries all neighbours at a step; @a best is what the sphere gains.
/// @return whether one was better, and taken.
bool stepUp(const GainWindow& window, LocalSphere& sphere, int64_t& best, int64_t step, bool flat)
{
    const auto radius = int64_t(std::lround(std::sqrt(double(sphere.radiusSq))));
    LocalSphere found = sphere;
    bool any = false;
    for (int move = 0; move < 81; ++move) {
        const int by[4] = {move % 3 - 1, move / 3 % 3 - 1, move / 9 % 3 - 1, move / 27 - 1};
        if (flat && by[2] != 0) continue;
        LocalSphere trial = sphere;
        for (int a = 0; a < 3; ++a) trial.center[a] += by[a] * step;
        const int64_t larger = radius + by[3] * step;
        if (by[3] != 0) trial.radiusSq = larger * larger;
        if (larger < tight::kFine / 4 || !window.holds(trial)) continue;
        const int64_t gain = window.gain(trial);
        if (gain <= best) continue;
        best = gain;
        found = trial;
        any = true;
    }
    sphere = found;
    return any;
}

} // namespace

int64_t climb(const GainWindow& window, LocalSphere& sphere, bool flat)
{
    int64_t best = window.gain(sphere);
    for (int64_t step = kLargestStep; step >= kSmallestStep; step /= 2) {
        while (stepUp(window, sphere, best, step, flat)) {}
    }
    return best;
}

} // namespace openvdb_spheretree::nearest
