// SPDX-License-Identifier: Apache-2.0
#include "TightEstimate.h"

#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/slab/LabelStream.h>
#include <openvdb_spheretree/tight/level/LevelWork.h>
#include <openvdb_spheretree/tight/region/CoarseObject.h>
#include <openvdb_spheretree/tight/region/WorkingMemory.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <algorithm>
#include <cmath>
#include <string>

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

/// @return how many times as many leaf balls the next finer level of the pyramid has.
/// @param ofVoxels  how many there are for each voxel
double growthOf(Leaves leaves, double ofVoxels)
{
    // Medial balls of solids lie in sheets, and the finer the voxels, the more of them are not
    // needed. Where they are most voxels, the object is a sheet itself.
    constexpr double kPruned = 3.5, kMedial = 4.5, kOfSheets = 4, kMost = 0.5;
    if (leaves == Leaves::Medial) return kMedial;
    return ofVoxels > kMost ? kOfSheets : kPruned;
}

GuessedObject guessedObject(const CoarseObject& coarse, const TightOptions& options)
{
    const CoarseSize size = sizeFor(options);
    GuessedObject guess{coarse.steps.size(), double(coarse.leaves.balls.size())};
    int64_t voxels = detail::countVoxels(*coarse.levels[guess.level]);
    while (guess.level > 0 && guess.leafBalls < double(size.leafBalls) && voxels < size.voxels) {
        --guess.level;
        const double grown =
            growthOf(options.leaves, guess.leafBalls / double(voxels)) * guess.leafBalls;
        voxels = detail::countVoxels(*coarse.levels[guess.level]);
        guess.leafBalls = std::min(grown, double(voxels));
    }
    return guess;
}

/// The regions of all leaf balls, as if each were one of a coarse level, as many times as large. In
/// thin or scattered objects most of such a ball is empty: there, a leaf node is in as many of them
/// as on the coarse level, times the ratio of their numbers.
double bytesOfLeafRegions(const CoarseObject& coarse, const GuessedObject& guess,
    openvdb::util::NullInterrupter* interrupter)
{
    const std::size_t last = coarse.steps.size();
    if (guess.level == last) { // nothing is guessed
        WorkingMemory regions;
        return regions.addRegions(coarse.leaves.balls, coarse.samples.level(0), interrupter).bytes;
    }
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
    SphereTreeSettings unbounded = settings;
    unbounded.memory = 0;
    StageSeconds seconds;
    const CoarseObject coarse = coarseObject(voxels, unbounded, kEnough, interrupter, &seconds);
    const GuessedObject guess = guessedObject(coarse, options);
    const auto leafBalls = int64_t(guess.leafBalls);
    const std::size_t leafNodes = leafNodesOf(coarse, guess.level);
    const LevelMaker maker =
        levelMakerFor(settings, coarse.samples, std::size_t(leafBalls), nullptr);
    const LevelWork work(maker, leafNodes);
    const std::vector<int64_t> counts = options.budget.counts(leafBalls);

    const bool allLeaves = !options.budget.hasBound() && counts.front() == leafBalls;
    TightEstimate estimate;
    estimate.leafBalls = guess.leafBalls;
    estimate.labelled = coarse.levels[guess.level];
    WorkingMemory memory = leastAllowed(settings, leafNodesOf(coarse, 0));
    estimate.leastBytes = memory.bytes;
    estimate.bytes = memory.addMerging(std::size_t(leafBalls)).bytes;
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
    }
    if (makesLeafRegions(options, allLeaves)) {
        estimate.bytes += bytesOfLeafRegions(coarse, guess, interrupter);
    }
    return estimate;
}

void refuseTightTree(
    const TightEstimate& estimate, const SphereTreeSettings& settings, double atLeast)
{
    const LeafLayout layout(*estimate.labelled);
    const auto ofLabels = double(slab::LabelStream(layout, settings.dim).enoughBytes());
    const double needed = std::max({estimate.bytes, ofLabels, atLeast});
    const bool fewerHelp = needed == estimate.bytes && !settings.tight().budget.hasBound();
    const std::string what = "a tight tree of this object needs about " + detail::asText(needed)
        + ", and memory= allows "
        + detail::asText(double(detail::allowedMemory(settings.memory)), false);
    throw detail::MemoryError(what + ": try " + detail::asMemoryOption(needed)
            + ", use a larger voxel, or "
            + (fewerHelp ? "ask for fewer spheres (spheres=)" : "split the object"),
        needed);
}

} // namespace openvdb_spheretree::tight
