// SPDX-License-Identifier: Apache-2.0
#include "SearchedLevels.h"

#include "CoarserLevel.h"
#include "FinerLevel.h"
#include "FreeLevel.h"
#include "LevelMaker.h"
#include <openvdb_spheretree/tight/region/PowerCells.h>

#include <utility>

namespace openvdb_spheretree {
namespace tight {

namespace {

/// Makes the levels above levels[from].
void makeCoarser(std::vector<TightLevel>& levels, std::size_t from,
    const std::vector<int64_t>& counts, const LevelMaker& maker)
{
    if (from + 1 == levels.size()) return;
    auto regions = regionsOf(levels[from].balls, maker.object.level(0), maker.interrupter);
    for (std::size_t k = from + 1; k < levels.size(); ++k) {
        levels[k] = coarserLevel(levels[k - 1], regions, counts[k], maker);
    }
}

/// Makes the levels below levels[from].
void makeFiner(std::vector<TightLevel>& levels, std::size_t from,
    const std::vector<int64_t>& counts, const std::vector<ExactSphere>& leafBalls,
    const LevelMaker& maker)
{
    if (from == 0) return;
    const BallCells cells{
        leafBalls, powerCells(leafBalls, maker.object.level(0), maker.interrupter)};
    std::vector<VoxelRegion> regions;
    for (std::size_t k = levels.size(); k-- > 0;) {
        if (k < from) levels[k] = finerLevel(levels[k + 1], regions, cells, counts[k], maker);
        if (k > 0) regions = chainRegions(levels[k], regions, maker);
    }
}

} // namespace

std::vector<TightLevel> searchedLevels(const std::vector<ForestNode>& forest,
    const std::vector<int64_t>& counts, const std::vector<MedialBall>& medial, std::size_t middle,
    const SampledObject& object, const FitEffort& effort, bool flat,
    openvdb::util::NullInterrupter* interrupter)
{
    const LevelMaker maker{object, effort, flat, interrupter};
    const std::vector<ExactSphere> leafBalls = ballsOfCut(forest, int64_t(medial.size()));
    std::vector<TightLevel> levels(counts.size());
    if (counts.front() == int64_t(medial.size())) {
        levels.front() = {leafBalls, {}, medial};
        makeCoarser(levels, 0, counts, maker);
        return levels;
    }
    levels[middle].balls = freeLevel(forest, counts[middle], leafBalls, maker);
    makeCoarser(levels, middle, counts, maker);
    makeFiner(levels, middle, counts, leafBalls, maker);
    for (std::size_t k = 1; k < levels.size(); ++k) dropChildless(levels[k], levels[k - 1]);
    return levels;
}

} // namespace tight
} // namespace openvdb_spheretree
