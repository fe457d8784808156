// SPDX-License-Identifier: Apache-2.0
#include "FreeLevel.h"

#include "TightLevels.h"
#include <openvdb_spheretree/tight/fit/CoveringFit.h>
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

class FreeSearch {
public:
    FreeSearch(const std::vector<ForestNode>& forest, const std::vector<ExactSphere>& leafBalls,
        const LevelMaker& maker)
        : mForest(forest), mLeafBalls(ungrouped(leafBalls)), mMaker(maker),
          mGoal(maker.object.level(0))
    {}

    std::vector<ExactSphere> cheapest(int64_t count) const
    {
        std::vector<ExactSphere> best;
        double least = std::numeric_limits<double>::infinity();
        const int starts = startsFor(count);
        for (int start = 0; start < starts; ++start) {
            const int64_t many = count * kTimesAsMany[start];
            if (many > int64_t(mLeafBalls.size())) break;
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
    std::vector<ExactSphere> startFrom(int64_t many, int64_t count) const
    {
        constexpr int kTrialsPerBall = 20;
        const std::vector<ExactSphere> cut = ballsOfCut(mForest, many);
        if (many == count) return cut;
        const auto cover = full(mMaker.search(ungrouped(cut), mLeafBalls, mGoal, kTrialsPerBall));
        return mMaker.merged(
            cover, powerCellPoints(cover, mMaker.object.level(0), mMaker.interrupter), count);
    }

    std::vector<ExactSphere> searched(const std::vector<ExactSphere>& start, int number) const
    {
        return full(mMaker.search(
            ungrouped(start), mLeafBalls, mGoal, mMaker.trialsFor(start.size()), number));
    }

    std::vector<ExactSphere> full(const SearchedCover& cover) const
    {
        return ballsOf(filledUp(cover.balls, mLeafBalls));
    }

    const std::vector<ForestNode>& mForest;
    std::vector<CoverBall> mLeafBalls;
    const LevelMaker& mMaker;
    VoxelGoal mGoal;
};

} // namespace

std::vector<ExactSphere> freeLevel(const std::vector<ForestNode>& forest, int64_t count,
    const std::vector<ExactSphere>& leafBalls, const LevelMaker& maker)
{
    return FreeSearch(forest, leafBalls, maker).cheapest(count);
}

double costOfCover(
    const std::vector<ExactSphere>& balls, const SampledObject& object, const FitEffort& effort)
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
