// SPDX-License-Identifier: Apache-2.0
/// @file TopDownEffort.h
/// @brief How much work a level of few balls gets that is made from the top (TopDownLevels.h).

#pragma once

#include <openvdb_spheretree/tree/SphereTreeSettings.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

struct TopDownEffort {
    int seeds;                        ///< starts of as many clusters as the level has balls
    std::vector<int64_t> timesAsMany; ///< starts of so many times as many clusters, merged
    int kept;                         ///< starts that are placed anew
    int keptInGroups;                 ///< the same below another level, where it takes longer
    int trialsPerBall = 0;            ///< of the search of the best; 0: none
    int mostTrials = 0;
};

/// Starts of many balls take longer, and differ less; those of large objects take longer.
/// @param leaves  nodes of the object
TopDownEffort topDownEffort(Quality quality, int64_t count, std::size_t leaves);

} // namespace openvdb_spheretree::tight
