// SPDX-License-Identifier: Apache-2.0
#include "LevelEffort.h"

#include <openvdb_spheretree/tight/search/CoverPart.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::tight {

LevelEffort effortOf(Quality quality, std::size_t leafBalls)
{
    LevelEffort effort;
    if (quality == Quality::Fast) {
        effort.fit = {false, 4, 1, false, 16};
        effort.merging.diagonals = false;
        effort.neighbours = 2;
        effort.sweeps = kFewSweeps;
        effort.placesStart = false;
        effort.dilatedPerBall = 1.5;
        effort.dilatedAtLeast = 1024;
        return effort;
    }
    // The balls of larger objects are larger: with the samples that suit 4,000 leaf balls, the time
    // for each ball of a larger object would grow.
    constexpr double kMost = 40, kLeast = 16, kFew = 4000;
    const double samples =
        std::max(kLeast, std::min(kMost, kMost * std::sqrt(kFew / double(leafBalls))));
    effort.fit = {true, 12, 1, false, int(samples)};
    effort.merging.samples = int(samples);
    effort.searchedUpTo = kFewBalls;
    if (quality == Quality::Best) {
        effort.fit.restarts = true;
        effort.relocations = 6;
        effort.searchedUpTo = INT64_MAX;
        effort.searches = 6;
        effort.trialsPerBall = 40;
        effort.childMoves = 8;
        effort.dilatedPerBall = 4;
        effort.dilatedAtLeast = 4096;
    }
    return effort;
}

} // namespace openvdb_spheretree::tight
