// SPDX-License-Identifier: Apache-2.0
#include "SearchedLevels.h"

#include "CoarserLevel.h"
#include "FinerLevel.h"
#include "FreeLevel.h"
#include <openvdb_spheretree/tight/region/PowerCells.h>

namespace openvdb_spheretree::tight {

std::vector<TightLevel> searchedLevels(const std::vector<ForestNode>& forest,
    const std::vector<int64_t>& counts, const LeafBalls& leaves, std::size_t middle,
    const LevelMaker& maker)
{
    const std::vector<ExactSphere>& leafBalls = leaves.balls;
    const SampleLevel& voxels = maker.object.level(0);
    std::vector<TightLevel> levels(counts.size());
    const bool beginsWithLeaves = counts.front() == int64_t(leafBalls.size());
    const std::size_t first = beginsWithLeaves ? 0 : middle;
    if (beginsWithLeaves) levels[first] = {leafBalls, {}, leaves.digital};
    else levels[first].balls = freeLevel(forest, counts[first], leafBalls, maker);

    if (first + 1 < levels.size()) {
        auto regions = regionsOf(levels[first].balls, voxels, maker.interrupter);
        for (std::size_t k = first + 1; k < levels.size(); ++k) {
            levels[k] = coarserLevel(levels[k - 1], regions, counts[k], maker);
        }
    }
    if (beginsWithLeaves) return levels;
    if (first > 0) {
        const BallCells cells{leafBalls, powerCells(leafBalls, voxels, maker.interrupter)};
        std::vector<VoxelRegion> regions;
        for (std::size_t k = levels.size(); k-- > 0;) {
            if (k < first) levels[k] = finerLevel(levels[k + 1], regions, cells, counts[k], maker);
            if (k > 0) regions = chainRegions(levels[k], regions, maker);
        }
    }
    for (std::size_t k = 1; k < levels.size(); ++k) dropChildless(levels[k], levels[k - 1]);
    return levels;
}

} // namespace openvdb_spheretree::tight
