// SPDX-License-Identifier: Apache-2.0
#include "TightEstimate.h"

#include <openvdb_spheretree/tight/level/LevelWork.h>
#include <openvdb_spheretree/tight/region/CoarseObject.h>
#include <openvdb_spheretree/tight/region/WorkingMemory.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::tight {

namespace {

/// A level of the pyramid that levels are made on, with as many leaf balls as are guessed there.
struct GuessedObject {
    std::size_t level = 0; ///< of the pyramid
    double leafBalls = 0;
};

std::size_t leafNodesOf(const CoarseObject& coarse, std::size_t level)
{
    return std::size_t(detail::leafNodesOf(*coarse.levels[level]));
}

GuessedObject guessedObject(const CoarseObject& coarse, const CoarseSize& size)
{
    // Of leaf balls, from a level of the pyramid to the next finer one.
    constexpr double kGrowth = 3.5;
    GuessedObject guess{coarse.steps.size(), double(coarse.leaves.balls.size())};
    int64_t voxels = detail::countVoxels(*coarse.levels[guess.level]);
    while (guess.level > 0 && guess.leafBalls < double(size.leafBalls) && voxels < size.voxels) {
        --guess.level;
        voxels = detail::countVoxels(*coarse.levels[guess.level]);
        guess.leafBalls = std::min(kGrowth * guess.leafBalls, double(voxels));
    }
    return guess;
}

/// The regions of all leaf balls, as if each were one of a coarse level, as many times as large. In thin or scattered
/// objects most of such a ball is empty: there, a leaf node is in as many of them as on the coarse level, times the
/// ratio of their numbers.
double bytesOfLeafRegions(const CoarseObject& coarse, const GuessedObject& guess)
{
    const std::size_t last = coarse.steps.size();
    const std::size_t leafNodes = leafNodesOf(coarse, guess.level),
                      coarseNodes = leafNodesOf(coarse, last);
    const double scale = std::exp2(double(last - guess.level));
    std::vector<ExactSphere> balls = coarse.leaves.balls;
    WorkingMemory coarseRegions, regions;
    coarseRegions.guessRegions(balls, coarseNodes);
    for (ExactSphere& ball : balls) ball.radiusSq = int64_t(double(ball.radiusSq) * scale * scale);
    regions.guessRegions(balls, leafNodes);
    const double ofNodes = coarseRegions.bytes * double(leafNodes) / double(coarseNodes);
    return std::min(regions.bytes, ofNodes) * guess.leafBalls / double(balls.size());
}

/// Regions of covers at most: each leaf node is in about three of a level's balls.
double bytesOfCoverRegions(const std::vector<int64_t>& counts, std::size_t leafNodes)
{
    constexpr double kTimes = 3, kWhole = 0.5;
    const double leaves = kTimes * double(leafNodes);
    return double(counts.size()) * regionBytes(leaves, kWhole * leaves);
}

/// The work for one forest of all merges.
double secondsOfForest(const TightOptions& options, double leafBalls)
{
    constexpr double kStrict = 0.2e-3, kSlack = 3e-3;
    const bool strict = options.quality == Quality::Fast || options.cover == Cover::Balls;
    return (strict ? kStrict : kSlack) * leafBalls;
}

} // namespace

TightEstimate estimateTightTree(const openvdb::MaskTree::ConstPtr& voxels,
    const SphereTreeSettings& settings, openvdb::util::NullInterrupter* interrupter)
{
    constexpr CoarseSize kEnough{2000, 2000000}; // to guess from
    const TightOptions& options = settings.tight();
    StageSeconds seconds;
    const CoarseObject coarse = coarseObject(voxels, settings, kEnough, interrupter, &seconds);
    const GuessedObject guess = guessedObject(coarse, sizeFor(options));
    const auto leafBalls = int64_t(guess.leafBalls);
    const std::size_t leafNodes = leafNodesOf(coarse, guess.level);
    const LevelMaker maker =
        levelMakerFor(settings, coarse.samples, std::size_t(leafBalls), nullptr);
    const LevelWork work(maker, leafNodes);
    const std::vector<int64_t> counts = options.budget.counts(leafBalls);

    const bool allLeaves = !options.budget.hasBound() && counts.front() == leafBalls;
    TightEstimate estimate;
    estimate.leafBalls = guess.leafBalls;
    WorkingMemory memory;
    memory.addSamples(leafNodesOf(coarse, 0)).addMerging(std::size_t(leafBalls));
    estimate.bytes = memory.bytes;
    if (options.cuts || options.cover == Cover::Balls) {
        estimate.seconds = secondsOfForest(options, guess.leafBalls);
    } else if (options.budget.hasBound()) {
        const std::vector<int64_t> usual{kFewBalls, 8, 1}; // nobody knows
        estimate.seconds = 2 * work.ofFreeCover(leafBalls, 1) + work.ofSearches(usual.front())
            + work.fromBottom(usual);
    } else if (allLeaves) {
        estimate.seconds = work.fromBottom(counts);
    } else {
        estimate.seconds =
            work.ofCounts(leafBalls, counts, options.quality, coarse.leafNodesBelow(guess.level));
        estimate.bytes += bytesOfCoverRegions(counts, leafNodesOf(coarse, 0));
    }
    if (makesLeafRegions(options, allLeaves)) {
        estimate.bytes += bytesOfLeafRegions(coarse, guess);
    }
    return estimate;
}

} // namespace openvdb_spheretree::tight
