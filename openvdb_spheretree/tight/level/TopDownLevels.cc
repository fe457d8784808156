// SPDX-License-Identifier: Apache-2.0
#include "TopDownLevels.h"

#include "GroupedCover.h"
#include "LevelRegions.h"
#include "LevelWork.h"
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/tight/cluster/ClusterCover.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// Starts already have their balls where they are needed.
constexpr std::size_t kRelocations = 2;
constexpr FitEffort kStartFit{false, 4, 1, false, 16}; // of starts: they are placed anew later

/// How much work a level gets.
struct LevelEffort {
    int seeds;                        ///< starts of as many clusters as the level has balls
    std::vector<int64_t> timesAsMany; ///< starts of so many times as many clusters, merged
    int kept;                         ///< starts that are placed anew
    int keptInGroups;                 ///< the same below another level, where it takes longer
    int trialsPerBall = 0;            ///< of the search of the best; 0: none
    int mostTrials = 0;
};

/// Starts of many balls take longer, and differ less; those of large objects take longer.
LevelEffort effortOf(Quality quality, int64_t count, std::size_t leaves)
{
    const bool many = count > 32, large = leaves > 1000;
    const auto fewer = [&](int starts) {
        return std::max(2, int(starts * 8 / std::max<int64_t>(8, count)));
    };
    if (quality == Quality::Fast) {
        return large ? LevelEffort{fewer(4), {2}, 1, 1}
                     : LevelEffort{fewer(4), {many ? 8 : 4}, 2, 1};
    }
    if (quality == Quality::Best) return {fewer(96), {2, 4, 8}, fewer(24), 8, 100, 6400};
    if (large && many) return {2, {2, 4}, 2, 2, 16, 640};
    return {fewer(large ? 16 : 48), {2, 4, 8}, fewer(large ? 4 : 12), many ? 2 : 3, 16, 640};
}

/// The balls of a level with their groups, and what they cost.
struct Found {
    std::vector<CoverBall> balls;
    double cost = std::numeric_limits<double>::infinity();
};

class TopDownLevels {
public:
    TopDownLevels(FreeCovers& free, bool withClusters, Quality quality, const LevelMaker& maker)
        : mFree(free), mMaker(maker), mVoxels(maker.object.level(0)), mQuality(quality)
    {
        if (withClusters) mBlocks = voxelBlocks(mVoxels, kBlocks);
    }

    /// Makes the next finer level.
    TightLevel next(int64_t count)
    {
        const bool isFirst = mAbove.balls.empty();
        const Found fewer = isFirst ? oneBall() : mFound;
        Found best = fewer.cost > 0 && count > 1 ? searched(count, fewer.cost) : Found();
        if (fewer.cost <= best.cost) best = {eachInItsGroup(ballsOf(fewer.balls)), fewer.cost};
        TightLevel level;
        level.balls = ballsOf(best.balls);
        if (!isFirst) level.parent = groupsOf(best.balls);
        mRegions = chainRegions(level, mRegions, mMaker);
        mFound = std::move(best);
        mAbove = level;
        return level;
    }

private:
    static constexpr std::size_t kBlocks = 4096;

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
        const LevelEffort effort = effortOf(mQuality, count, mVoxels.leafCount());
        Found best = [&] {
            const detail::Step step(mMaker.interrupter, kStarts * work);
            const detail::Stage loops("", mMaker.interrupter, nullptr); // each is a detail
            return bestStart(count, fewer);
        }();
        const detail::Step step(mMaker.interrupter, kSearch * work);
        if (best.balls.empty() || best.cost <= 0) return best;
        const int trials = trialsFor(best.balls, effort);
        if (trials == 0) return best;
        Found found = improved(best.balls, trials);
        return found.cost < best.cost ? found : best;
    }

    /// @return the start that is cheapest after it was placed anew.
    Found bestStart(int64_t count, double fewer) const
    {
        // Of an object like a ball many clusters cost many times what one ball costs, as each must hold
        // corners of its own; few of them may still be better.
        constexpr double kHopeless = 4;
        constexpr int64_t kFewer = 8, kFewest = 2;
        const LevelEffort effort = effortOf(mQuality, count, mVoxels.leafCount());
        const std::vector<Found> starts = startsOf(count, effort);
        if (starts.front().cost > kHopeless * fewer) {
            const int64_t less = std::max(
                mAbove.balls.empty() ? kFewest : int64_t(mAbove.balls.size()) + 1, count / kFewer);
            return less < count ? bestStart(less, fewer) : Found();
        }
        Found best;
        const int kept = mAbove.balls.empty() ? effort.kept : effort.keptInGroups;
        for (int i = 0; i < std::min(kept, int(starts.size())); ++i) {
            Found placed = improved(inGroups(starts[i].balls, count), 0);
            if (placed.cost < best.cost) best = std::move(placed);
        }
        return best;
    }

    /// @return covers of at most @a count balls, the cheapest first, and one of each cost.
    std::vector<Found> startsOf(int64_t count, const LevelEffort& effort) const
    {
        std::vector<Found> starts;
        const auto add = [&](const std::vector<ExactSphere>& balls) {
            starts.push_back(withCost(ungrouped(balls)));
        };
        add(mFree.cover(count));
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
        const SearchEffort effort{
            mMaker.fit, trialsPerBall, 0, mMaker.flat, kRelocations, mMaker.sweeps};
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
    int trialsFor(const std::vector<CoverBall>& balls, const LevelEffort& effort) const
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
};

} // namespace

std::vector<TightLevel> topDownLevels(const std::vector<int64_t>& counts, FreeCovers& free,
    bool withClusters, Quality quality, const LevelMaker& maker)
{
    for (const int64_t count : counts) { // fewer balls come from more
        if (count > 1) free.cover(count);
    }
    TopDownLevels from(free, withClusters, quality, maker);
    std::vector<TightLevel> levels(counts.size());
    for (std::size_t k = counts.size(); k-- > 0;) levels[k] = from.next(counts[k]);
    for (std::size_t k = 1; k < levels.size(); ++k) dropChildless(levels[k], levels[k - 1]);
    return levels;
}

bool areFromTopAlone(const std::vector<int64_t>& counts, Quality quality)
{
    return counts.size() == 1 || quality == Quality::Fast;
}

} // namespace openvdb_spheretree::tight
