// SPDX-License-Identifier: Apache-2.0
#include "TopDownLevels.h"

#include "GroupedCover.h"
#include "LevelRegions.h"
#include "LevelWork.h"
#include "TopDownEffort.h"
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/tight/cluster/ClusterCover.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

constexpr FitEffort kStartFit{false, 4, 1, false, 16}; // of starts: they are placed anew later

/// The balls of a level with their groups, and what they cost.
struct Found {
    std::vector<CoverBall> balls;
    double cost = std::numeric_limits<double>::infinity();
};

/// @return the one that costs less; of two as good the first.
Found better(Found one, Found other)
{
    return other.cost < one.cost ? std::move(other) : std::move(one);
}

class TopDownLevels {
public:
    TopDownLevels(FreeCovers& free, bool withClusters, Quality quality, const LevelMaker& maker)
        : mFree(free), mMaker(maker), mVoxels(maker.object.level(0)), mQuality(quality)
    {
        if (withClusters) mBlocks = voxelBlocks(mVoxels, kBlocks);
    }

    /// @return levels of these counts. None costs more than its given one, if levels are given.
    std::vector<TightLevel> make(
        const std::vector<int64_t>& counts, const std::vector<TightLevel>& given)
    {
        std::vector<TightLevel> levels(counts.size());
        mIsBelowGiven = !given.empty(); // above the coarsest, there is nothing
        for (std::size_t k = counts.size(); k-- > 0;) {
            mGiven = given.empty() ? Found() : foundOf(given[k]);
            Found level = nextLevel(counts[k]);
            if (mGiven.cost < level.cost) {
                std::copy(given.begin() + k + 1, given.end(), levels.begin() + k + 1);
                startBelow(given, k + 1);
                level = nextLevel(counts[k]);
            }
            levels[k] = goOn(std::move(level));
            mIsBelowGiven = mIsBelowGiven && levels[k].balls == given[k].balls
                && levels[k].parent == given[k].parent;
        }
        return levels;
    }

private:
    static constexpr std::size_t kBlocks = 4096;

    Found nextLevel(int64_t count) const
    {
        const Found fewer = mAbove.balls.empty() ? oneBall() : mFound;
        Found best = mIsBelowGiven ? mGiven : Found();
        if (fewer.cost > 0 && count > 1) best = better(best, searched(count, fewer.cost));
        if (fewer.cost <= best.cost) best = {eachInItsGroup(ballsOf(fewer.balls)), fewer.cost};
        return best;
    }

    /// Goes on below a level, which hangs below the one before.
    TightLevel goOn(Found level)
    {
        const bool isFirst = mAbove.balls.empty();
        mAbove = {
            ballsOf(level.balls), isFirst ? std::vector<int32_t>() : groupsOf(level.balls), {}};
        mMaker.requireRoomForRegions(mAbove.balls);
        mRegions = chainRegions(mAbove, mRegions, mMaker);
        mFound = std::move(level);
        return mAbove;
    }

    /// Goes on below the given levels, of which this is the finest, in place of its own.
    void startBelow(const std::vector<TightLevel>& given, std::size_t finest)
    {
        mIsBelowGiven = true;
        mAbove = {};
        mRegions.clear();
        for (std::size_t k = given.size(); k-- > finest;) goOn(foundOf(given[k]));
    }

    /// @return a level, with parents as groups, and what it costs.
    Found foundOf(const TightLevel& level) const
    {
        std::vector<CoverBall> balls = ungrouped(level.balls);
        for (std::size_t i = 0; i < level.parent.size(); ++i) balls[i].group = level.parent[i];
        return withCost(std::move(balls));
    }

    /// One ball is one fit: it gets all the effort there is.
    Found oneBall() const
    {
        if (mBlocks.empty()) return withCost(ungrouped(mFree.cover(1)));
        constexpr FitEffort kAll{true, 12, 1, true, 40};
        return withCost(ungrouped(clusterCover(
            clusterCenters(mBlocks, 1, 0), mMaker.object, kAll, mMaker.flat, mMaker.interrupter)));
    }

    /// @param fewer  what fewer balls cost
    Found searched(int64_t count, double fewer) const
    {
        constexpr double kStarts = 0.4, kSearch = 0.6; // of the work
        const double work = LevelWork(mMaker).fromTop(count, mQuality);
        const TopDownEffort effort = topDownEffort(mQuality, count, mVoxels.leafCount());
        Found best = [&] {
            const detail::Step step(mMaker.interrupter, kStarts * work);
            const detail::Stage loops("", mMaker.interrupter, nullptr); // each is a detail
            const Found start = bestStart(count, fewer);
            return mIsBelowGiven ? better(start, improved(mGiven.balls, 0)) : start;
        }();
        const detail::Step step(mMaker.interrupter, kSearch * work);
        if (best.balls.empty() || best.cost <= 0) return best;
        const int trials = trialsFor(best.balls, effort);
        if (trials == 0) return best;
        return better(best, improved(best.balls, trials));
    }

    /// @return the start that is cheapest after it was placed anew.
    Found bestStart(int64_t count, double fewer) const
    {
        // Of an object like a ball many clusters cost many times what one ball costs, as each must
        // hold corners of its own; few of them may still be better.
        constexpr double kHopeless = 4;
        constexpr int64_t kFewer = 8, kFewest = 2;
        const TopDownEffort effort = topDownEffort(mQuality, count, mVoxels.leafCount());
        const std::vector<Found> starts = startsOf(count, effort);
        if (starts.front().cost > kHopeless * fewer) {
            const int64_t less = std::max(
                mAbove.balls.empty() ? kFewest : int64_t(mAbove.balls.size()) + 1, count / kFewer);
            return less < count ? bestStart(less, fewer) : Found();
        }
        Found best;
        const int kept = mAbove.balls.empty() ? effort.kept : effort.keptInGroups;
        for (int i = 0; i < std::min(kept, int(starts.size())); ++i) {
            best = better(best, improved(inGroups(starts[i].balls, count), 0));
        }
        return best;
    }

    /// @return covers of at most @a count balls, the cheapest first, and one of each cost.
    std::vector<Found> startsOf(int64_t count, const TopDownEffort& effort) const
    {
        std::vector<Found> starts;
        const auto add = [&](const std::vector<ExactSphere>& balls) {
            starts.push_back(withCost(ungrouped(balls)));
        };
        add(mFree.cover(count));
        const bool isGiven = !mIsBelowGiven && !mGiven.balls.empty();
        if (isGiven && int64_t(mGiven.balls.size()) <= count) add(ballsOf(mGiven.balls));
        if (!mBlocks.empty()) {
            for (int seed = 0; seed < effort.seeds; ++seed) add(clusters(count, uint64_t(seed)));
            for (const int64_t times : effort.timesAsMany) add(mergedClusters(count, times));
        }
        std::stable_sort(starts.begin(), starts.end(),
            [](const Found& a, const Found& b) { return a.cost < b.cost; });
        starts.erase(std::unique(starts.begin(), starts.end(),
                         [](const Found& a, const Found& b) { return a.cost == b.cost; }),
            starts.end());
        return starts;
    }

    std::vector<ExactSphere> clusters(int64_t count, uint64_t seed) const
    {
        return clusterCover(clusterCenters(mBlocks, std::size_t(count), seed), mMaker.object,
            kStartFit, mMaker.flat, mMaker.interrupter);
    }

    std::vector<ExactSphere> mergedClusters(int64_t count, int64_t times) const
    {
        return mMaker.mergedCover(clusters(count * times, 1), false, count);
    }

    /// @return a start within the groups of the level above.
    std::vector<CoverBall> inGroups(const std::vector<CoverBall>& start, int64_t count) const
    {
        if (mAbove.balls.empty()) return start;
        const GroupedCover dealt = dealtOut(ballsOf(start), mAbove, mRegions, mMaker);
        const TightLevel below{ballsOf(dealt.balls), groupsOf(dealt.balls), {}};
        return mMaker.mergedWithSlack(dealt.balls, chainRegions(below, mRegions, mMaker), count);
    }

    Found improved(const std::vector<CoverBall>& balls, int trialsPerBall) const
    {
        const VoxelGoal goal =
            mAbove.balls.empty() ? VoxelGoal(mVoxels) : VoxelGoal(mVoxels, mRegions);
        const SearchEffort effort{mMaker.fitOf(int64_t(balls.size())), trialsPerBall, 0,
            mMaker.flat, mMaker.relocations, mMaker.sweeps};
        const auto spare = detail::timed("", mMaker.interrupter, nullptr, [&] {
            return trialsPerBall > 0 ? smallerThan(int64_t(balls.size()))
                                     : std::vector<CoverBall>();
        });
        return withCost(withoutEmpty(
            improveCover(balls, spare, mMaker.object, goal, effort, mMaker.interrupter).balls));
    }

    /// @return balls that a search can insert.
    std::vector<CoverBall> smallerThan(int64_t count) const
    {
        constexpr int64_t kSmaller = 4; // balls, for each of the level
        const auto smaller =
            mBlocks.empty() ? mFree.cover(kSmaller * count) : clusters(kSmaller * count, 1);
        return mAbove.balls.empty() ? ungrouped(smaller)
                                    : dealtOut(smaller, mAbove, mRegions, mMaker).balls;
    }

    /// A trial takes longer where balls are large. A search of few trials is none: what moves balls
    /// elsewhere would take most of its time.
    int trialsFor(const std::vector<CoverBall>& balls, const TopDownEffort& effort) const
    {
        const std::size_t leavesInAll =
            mQuality == Quality::Best ? 300000 : 30000; // in all trials' balls
        constexpr int kFewest = 10;
        if (effort.trialsPerBall == 0) return 0;
        std::size_t leaves = 1;
        for (const CoverBall& ball : balls) leaves += regionOf(ball.ball, mVoxels).size();
        const int most = std::min(effort.mostTrials / int(balls.size()), int(leavesInAll / leaves));
        return most < kFewest ? 0 : std::min(effort.trialsPerBall, most);
    }

    Found withCost(std::vector<CoverBall> balls) const
    {
        const double cost = mMaker.costOf(ballsOf(balls));
        return {std::move(balls), cost};
    }

    FreeCovers& mFree;
    const LevelMaker& mMaker;
    const SampleLevel& mVoxels;
    const Quality mQuality;
    std::vector<VoxelBlock> mBlocks;   ///< empty: no clusters
    TightLevel mAbove;                 ///< the level above; without balls at first
    Found mFound;                      ///< the same with its groups
    std::vector<VoxelRegion> mRegions; ///< chainRegions() of it
    Found mGiven; ///< the given level of the same count; without balls if there is none
    /// The level above is the given one, so that `mGiven` has its groups; for the coarsest: there
    /// are given ones.
    bool mIsBelowGiven = false;
};

} // namespace

std::vector<TightLevel> topDownLevels(const std::vector<int64_t>& counts, FreeCovers& free,
    bool withClusters, Quality quality, const LevelMaker& maker,
    const std::vector<TightLevel>& given)
{
    for (const int64_t count : counts) { // fewer balls come from more
        if (count > 1) free.cover(count);
    }
    auto levels = TopDownLevels(free, withClusters, quality, maker).make(counts, given);
    for (std::size_t k = 1; k < levels.size(); ++k) dropChildless(levels[k], levels[k - 1]);
    return levels;
}

} // namespace openvdb_spheretree::tight
