// SPDX-License-Identifier: Apache-2.0
#include "FewLevels.h"

#include "TopDownLevels.h"

namespace openvdb_spheretree::tight {

std::vector<TightLevel> fewLevels(const std::vector<int64_t>& counts, FreeCovers& free,
    bool withClusters, Quality quality, const LevelMaker& maker)
{
    std::vector<TightLevel> lower;
    if (quality != Quality::Fast) {
        const Quality less = quality == Quality::Best ? Quality::Normal : Quality::Fast;
        const LevelMaker quicker = maker.ofQuality(less, free.startSize());
        FreeCovers covers = free.sameStart(quicker);
        lower = fewLevels(counts, covers, withClusters, less, quicker);
    }
    return topDownLevels(counts, free, withClusters, quality, maker, lower);
}

} // namespace openvdb_spheretree::tight
