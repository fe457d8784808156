// SPDX-License-Identifier: Apache-2.0
#include "LevelWork.h"

#include "FreeCovers.h"
#include <openvdb_spheretree/tight/region/DilatedCover.h>

#include <algorithm>

namespace openvdb_spheretree::tight {

double LevelWork::ofMerging(int64_t balls, int64_t count) const
{
    const double perMerge = mMaker.mergingTo(count).diagonals ? 250e-6 : 130e-6;
    return perMerge * double(std::max<int64_t>(0, balls - count));
}

double LevelWork::ofDilating(int64_t balls, int64_t few) const
{
    constexpr double kPruning = 10e-6, kLeaf = 2e-6, kFit = 40e-6;
    return kPruning * double(balls) + kLeaf * mLeaves + kFit * double(few);
}

double LevelWork::ofPlacing(int64_t balls, bool isBetween) const
{
    const bool isQuick = isBetween || mMaker.sweeps <= kFewSweeps;
    const double perBall = isQuick ? 90e-6 : 150e-6, perLeaf = isQuick ? 0.8e-6 : 2e-6;
    return perBall * double(balls) + perLeaf * mLeaves;
}

double LevelWork::ofSearch(int64_t balls) const
{
    constexpr double kTrial = 0.5e-3, kRelocation = 3.3e-3;
    return (kTrial * mMaker.trialsOf(balls) + kRelocation * double(mMaker.relocations))
        * double(balls);
}

double LevelWork::ofSearches(int64_t balls) const
{
    const bool any = mMaker.searchesLevelOf(std::size_t(balls));
    return any ? mMaker.searchesOf(balls) * ofSearch(balls) : 0;
}

double LevelWork::ofMoves(int64_t children) const
{
    const double rounds = 0.5 + mMaker.childMoves / 16.0; // the first ones take longest
    return rounds * (0.2e-3 + 0.1e-6 * mLeaves) * double(children);
}

double LevelWork::ofFreeCover(int64_t start, int64_t count) const
{
    const FreeCovers::Next first = FreeCovers::next(start, count, true, mMaker);
    const int64_t few = std::max(first.dilated, start / kMostPerDilated);
    double work = first.dilated > 0 ? ofDilating(start, few) + ofMerging(few, count)
                                    : ofMerging(start, count);
    for (int64_t many = start; many > count;) {
        const FreeCovers::Next next = FreeCovers::next(many, count, many == start, mMaker);
        if (next.isPlaced) work += ofPlacing(next.count, next.count > count);
        many = next.count;
    }
    return work;
}

double LevelWork::fromBottom(const std::vector<int64_t>& counts) const
{
    double work = 0;
    for (std::size_t k = 1; k < counts.size(); ++k) {
        const int64_t finer = counts[k - 1], count = counts[k];
        const bool isPlacedTwice = count <= kFewBalls || mMaker.searchesLevelOf(std::size_t(count));
        work += ofMerging(finer, count) + (isPlacedTwice ? 2 : 1) * ofPlacing(count);
        work += ofSearches(count);
        // Those of large balls are decided at less resolution.
        const double leaves = std::min(mLeaves, double(kLeavesOfLargeBall) * double(count));
        if (mMaker.searchesLevelOf(std::size_t(count))) {
            work += LevelWork(mMaker, std::size_t(leaves)).ofMoves(finer);
        }
    }
    return work;
}

double LevelWork::fromTop(int64_t count, Quality quality) const
{
    if (count == 1) return ofPlacing(1); // one ball is one fit
    if (quality == Quality::Fast) return 0.01 + 0.002 * double(count);
    if (quality == Quality::Best) return 0.9 + 0.075 * double(count);
    return 0.3 + 0.012 * double(count);
}

double LevelWork::ofCounts(int64_t leafBalls, const std::vector<int64_t>& counts, Quality quality,
    const std::vector<int64_t>& finer) const
{
    double work = 0;
    if (counts.front() > kFewBalls) {
        work += ofFreeCover(leafBalls, counts.front()) + ofSearches(counts.front());
        work += fromBottom(counts);
    } else {
        for (const Quality each : {Quality::Fast, Quality::Normal, Quality::Best}) { // FewLevels.h
            if (each > quality) continue;
            const LevelMaker maker = mMaker.ofQuality(each, std::size_t(leafBalls));
            work += LevelWork(maker, std::size_t(mLeaves)).ofFreeCover(leafBalls, counts.front());
            for (const int64_t count : counts) work += fromTop(count, each);
        }
    }
    for (const int64_t leaves : finer) {
        for (const int64_t count : counts) {
            work += LevelWork(mMaker, std::size_t(leaves)).ofPlacing(count);
        }
    }
    return work;
}

} // namespace openvdb_spheretree::tight
