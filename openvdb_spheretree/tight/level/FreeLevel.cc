// SPDX-License-Identifier: Apache-2.0
#include "FreeLevel.h"

#include "TightLevels.h"
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
#include <openvdb_spheretree/tight/merge/StrictMerging.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>
#include <openvdb_spheretree/tight/search/CoverGoal.h>
#include <openvdb_spheretree/tight/search/CoverPart.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace openvdb_spheretree {
namespace tight {

namespace {

/// Balls in the cover that a start is merged from, for each ball of the level; 1: not merged.
constexpr int kTimesAsMany[] = {1, 2, 3, 4, 5, 8};
constexpr int kMostStarts = int(sizeof kTimesAsMany / sizeof kTimesAsMany[0]);

/// With many balls all starts end alike, and each takes long.
int startsFor(int64_t count)
{
    constexpr int64_t kBalls = 128;
    return int(std::max<int64_t>(1, std::min<int64_t>(kMostStarts, kBalls / count)));
}

/// @return the balls of @a cover merged to @a count of them, each holding what its parts cover best.
std::vector<FineBall> mergedTo(
    int64_t count, const std::vector<FineBall>& cover, const LevelMaker& maker)
{
    constexpr int kNeighbours = 8;
    HeldByLeafBalls cells =
        heldVoxels(powerCellPoints(cover, maker.object.level(0), maker.interrupter));
    cells.areInside = false;
    StrictMerging merging(
        maker.object, cover, std::move(cells), maker.fit, maker.flat, maker.interrupter);
    return ballsOfCut(mergeToRoots(merging, kNeighbours, maker.interrupter), count);
}

class FreeSearch {
public:
    FreeSearch(const std::vector<ForestNode>& forest, const std::vector<FineBall>& leaves,
        const LevelMaker& maker)
        : mForest(forest), mLeaves(ungrouped(leaves)), mMaker(maker), mGoal(maker.object.level(0))
    {}

    std::vector<FineBall> cheapest(int64_t count) const
    {
        std::vector<FineBall> best;
        double least = std::numeric_limits<double>::infinity();
        const int starts = startsFor(count);
        for (int start = 0; start < starts; ++start) {
            const int64_t many = count * kTimesAsMany[start];
            if (many > int64_t(mLeaves.size())) break;
            auto found = searched(startFrom(many, count), start);
            if (starts == 1) return found;
            const double cost = costOfCover(found, mMaker.object, mMaker.fit);
            if (cost >= least) continue;
            least = cost;
            best = std::move(found);
        }
        return best;
    }

private:
    std::vector<FineBall> startFrom(int64_t many, int64_t count) const
    {
        constexpr int kTrialsPerBall = 20;
        const std::vector<FineBall> cut = ballsOfCut(mForest, many);
        if (many == count) return cut;
        return mergedTo(
            count, full(mMaker.search(ungrouped(cut), mLeaves, mGoal, kTrialsPerBall)), mMaker);
    }

    std::vector<FineBall> searched(const std::vector<FineBall>& start, int number) const
    {
        return full(mMaker.search(
            ungrouped(start), mLeaves, mGoal, mMaker.trialsFor(start.size()), number));
    }

    std::vector<FineBall> full(const SearchedCover& cover) const
    {
        return ballsOf(filledUp(cover.balls, mLeaves));
    }

    const std::vector<ForestNode>& mForest;
    std::vector<CoverBall> mLeaves;
    const LevelMaker& mMaker;
    VoxelGoal mGoal;
};

} // namespace

std::vector<FineBall> freeLevel(const std::vector<ForestNode>& forest, int64_t count,
    const std::vector<FineBall>& leaves, const LevelMaker& maker)
{
    return FreeSearch(forest, leaves, maker).cheapest(count);
}

double costOfCover(
    const std::vector<FineBall>& balls, const SampledObject& object, const FitEffort& effort)
{
    CoveringFit fit;
    double cost = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        fit.open(object, balls[i], effort.samples);
        for (std::size_t before = 0; before < i; ++before) {
            if (FineBox(balls[before]).meets(fit.box())) fit.cover(balls[before]);
        }
        cost += fit.costOf({balls[i]});
    }
    return cost;
}

} // namespace tight
} // namespace openvdb_spheretree
